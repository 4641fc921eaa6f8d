//! Wavefront OBJ: positions and faces.

use super::cursor::{Cursor, parse};
use super::{Found, Reading, Soup};

/// Faces name positions, texture coordinates and normals; only the positions make vertices, so that
/// seams of a texture do not tear the mesh.
pub(super) fn read(bytes: &[u8]) -> Reading {
    let mut cursor = Cursor::new(bytes);
    let (mut soup, mut colours, mut number) = (Soup::default(), Vec::new(), 0);
    while let Some(line) = cursor.line() {
        number += 1;
        let mut whole = line.to_vec();
        while whole.ends_with(b"\\") {
            whole.pop();
            whole.push(b' ');
            whole.extend(cursor.line().unwrap_or_default());
            number += 1;
        }
        read_line(&whole, &mut soup, &mut colours).map_err(|e| format!("line {number}: {e}"))?;
    }
    let colours = Some(colours).filter(|colours| !colours.is_empty());
    Ok(Found { colours, ..Found::new(soup) })
}

fn read_line(line: &[u8], soup: &mut Soup, colours: &mut Vec<[u8; 3]>) -> Result<(), String> {
    let text = line.split(|&c| c == b'#').next().unwrap_or_default();
    let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    match words.next() {
        Some(b"v") => {
            let numbers: Vec<f64> = words.map(parse).collect::<Result<_, _>>()?;
            let [x, y, z, more @ ..] = &numbers[..] else {
                return Err("a vertex needs three numbers".to_owned());
            };
            soup.push_point([*x, *y, *z]);
            if let [red, green, blue] = more {
                colours.push([red, green, blue].map(|part| (part * 255.0).round() as u8));
            }
        }
        Some(b"f") => {
            let points = soup.points().len();
            let corners = words.map(|word| corner(word, points)).collect::<Result<Vec<_>, _>>()?;
            soup.push(corners);
        }
        _ => {}
    }
    Ok(())
}

/// The vertex of a corner, `v`, `v/t`, `v//n` or `v/t/n`: counted from 1, or from the last one so far
/// if negative.
fn corner(word: &[u8], points: usize) -> Result<u32, String> {
    let number: i64 = parse(word.split(|&c| c == b'/').next().unwrap_or_default())?;
    let vertex = if number < 0 { number.checked_add(points as i64) } else { Some(number - 1) };
    vertex
        .and_then(|vertex| u32::try_from(vertex).ok())
        .ok_or_else(|| format!("a face uses vertex {number} of {points}"))
}
