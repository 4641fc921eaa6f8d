//! STL: triangles, each with its own points.

use super::super::format::is_binary_stl;
use super::cursor::{Cursor, Kind, Order, excerpt, truncated};
use super::{Found, Reading, Soup};

/// Text begins with `solid`, but so do some binary files.
pub(super) fn read(bytes: &[u8]) -> Reading {
    let is_text =
        bytes.trim_ascii_start().get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid"));
    let soup = if is_text && !is_binary_stl(bytes) { text(bytes) } else { binary(bytes) };
    soup.map(Found::new)
}

fn push_triangle(soup: &mut Soup, triangle: [[f64; 3]; 3]) -> Result<(), String> {
    let first = u32::try_from(soup.points().len()).map_err(|_| "too many triangles")?;
    triangle.into_iter().for_each(|point| soup.push_point(point));
    soup.push([first, first + 1, first + 2]);
    Ok(())
}

fn binary(bytes: &[u8]) -> Result<Soup, String> {
    let mut cursor = Cursor::new(bytes);
    cursor.take(80)?;
    let count = cursor.binary(Kind::U32, Order::Little)?;
    let mut soup = Soup::default();
    for _ in 0..count as u32 {
        let mut triangle = Cursor::new(cursor.take(50)?);
        triangle.take(12)?;
        let mut corners = [[0.0; 3]; 3];
        for coordinate in corners.iter_mut().flatten() {
            *coordinate = triangle.binary(Kind::F32, Order::Little)?;
        }
        push_triangle(&mut soup, corners)?;
    }
    Ok(soup)
}

fn text(bytes: &[u8]) -> Result<Soup, String> {
    let (mut cursor, mut soup) = (Cursor::new(bytes), Soup::default());
    let (mut corners, mut is_open) = (Vec::new(), false);
    while let Some(word) = cursor.word() {
        match &word.to_ascii_lowercase()[..] {
            b"solid" | b"endsolid" => {
                is_open = word.len() == 5;
                cursor.line();
            }
            b"facet" => drop(cursor.line()),
            b"outer" | b"loop" | b"endfacet" => {}
            b"vertex" => corners.push([cursor.number()?, cursor.number()?, cursor.number()?]),
            b"endloop" => {
                let found = corners.len();
                let triangle = corners.try_into();
                push_triangle(
                    &mut soup,
                    triangle.map_err(|_| format!("a facet has {found} vertices"))?,
                )?;
                corners = Vec::new();
            }
            _ => return Err(format!("expected a facet, found {:?}", excerpt(word))),
        }
    }
    if is_open { Err(truncated()) } else { Ok(soup) }
}
