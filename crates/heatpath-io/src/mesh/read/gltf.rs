//! glTF 2: the triangles of the scene, in the scene's coordinates.

use super::cursor::{Cursor, Kind, Order};
use super::{Found, Reading, Soup, push_strip};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;

/// A mesh may stand in a scene many times; more points than this are refused.
const MOST_POINTS: usize = 1 << 25;

/// A 4 x 4 matrix, column by column.
type Matrix = [f64; 16];

const IDENTITY: Matrix = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];

/// The kinds of primitives that are made of triangles.
const TRIANGLES: u64 = 4;
const STRIP: u64 = 5;
const FAN: u64 = 6;

struct Contents {
    json: Value,
    buffers: Vec<Vec<u8>>,
}

pub(super) fn read(bytes: &[u8]) -> Reading {
    let (text, mut chunk) = if bytes.starts_with(b"glTF") { chunks(bytes)? } else { (bytes, None) };
    let json: Value = serde_json::from_slice(text).map_err(|error| error.to_string())?;
    check_extensions(&json)?;
    let buffers = list(&json, "buffers").iter();
    let buffers = buffers.map(|buffer| contents(buffer, &mut chunk)).collect::<Result<_, _>>()?;
    let mut soup = Soup::default();
    Contents { json, buffers }.push_scene(&mut soup)?;
    Ok(Found::new(soup))
}

/// The JSON and the binary chunk of a GLB file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let mut cursor = Cursor::new(bytes);
    cursor.take(12)?;
    let (mut json, mut data) = (None, None);
    while cursor.rest().len() >= 8 {
        let length = cursor.binary(Kind::U32, Order::Little)? as usize;
        let name = cursor.take(4)?;
        let chunk = cursor.take(length)?;
        match name {
            b"JSON" => json = Some(chunk),
            b"BIN\0" => data = Some(chunk),
            _ => {}
        }
    }
    Ok((json.ok_or("has no JSON chunk")?, data))
}

fn check_extensions(json: &Value) -> Result<(), String> {
    let known = ["KHR_materials_unlit", "KHR_texture_transform"];
    let needed = list(json, "extensionsRequired").iter().filter_map(Value::as_str);
    match needed.into_iter().find(|name| !known.contains(name)) {
        Some(name) => Err(format!("needs the extension {name}, which is not read")),
        None => Ok(()),
    }
}

/// The bytes of a buffer: in its address, or the chunk of the file.
fn contents(buffer: &Value, chunk: &mut Option<&[u8]>) -> Result<Vec<u8>, String> {
    let Some(address) = buffer.get("uri").and_then(Value::as_str) else {
        return Ok(chunk.take().ok_or("has a buffer without data")?.to_vec());
    };
    let coded = address.strip_prefix("data:").and_then(|data| data.split_once(";base64,"));
    let (_, coded) = coded.ok_or("has a buffer in another file, which is not read; GLB is")?;
    STANDARD.decode(coded).map_err(|error| format!("base64: {error}"))
}

/// A list of the JSON, empty if there is none.
fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

fn number(value: &Value, name: &str) -> Option<usize> {
    value.get(name)?.as_u64().and_then(|number| usize::try_from(number).ok())
}

impl Contents {
    /// All meshes that the nodes of the scene place, or all meshes as they are if there is no scene.
    fn push_scene(&self, soup: &mut Soup) -> Result<(), String> {
        let json = &self.json;
        let scene = list(json, "scenes").get(number(json, "scene").unwrap_or(0));
        let Some(scene) = scene else {
            return list(json, "meshes")
                .iter()
                .try_for_each(|mesh| self.push_mesh(soup, mesh, &IDENTITY));
        };
        let nodes = list(json, "nodes");
        let mut is_seen = vec![false; nodes.len()];
        let numbers = |node: &Value, name: &str| -> Vec<usize> {
            list(node, name).iter().filter_map(Value::as_u64).map(|node| node as usize).collect()
        };
        let mut stack: Vec<(usize, Matrix)> =
            numbers(scene, "nodes").into_iter().rev().map(|node| (node, IDENTITY)).collect();
        while let Some((number_of_node, above)) = stack.pop() {
            let node = nodes.get(number_of_node).ok_or("names a node that does not exist")?;
            if std::mem::replace(&mut is_seen[number_of_node], true) {
                return Err("has a node with two parents".to_owned());
            }
            let matrix = product(&above, &transform(node));
            let children = numbers(node, "children").into_iter().rev();
            stack.extend(children.map(|child| (child, matrix)));
            if let Some(mesh) = number(node, "mesh") {
                let mesh = list(json, "meshes").get(mesh);
                self.push_mesh(soup, mesh.ok_or("names a mesh that does not exist")?, &matrix)?;
            }
        }
        Ok(())
    }

    fn push_mesh(&self, soup: &mut Soup, mesh: &Value, matrix: &Matrix) -> Result<(), String> {
        for primitive in list(mesh, "primitives") {
            let mode = primitive.get("mode").and_then(Value::as_u64).unwrap_or(TRIANGLES);
            let positions = primitive.get("attributes").and_then(|a| number(a, "POSITION"));
            let (Some(positions), TRIANGLES..=FAN) = (positions, mode) else { continue };
            let first = soup.points().len();
            let positions = self.numbers(positions, "VEC3")?;
            let count = positions.len() / 3;
            if first + count > MOST_POINTS {
                return Err(format!("has more than {MOST_POINTS} points"));
            }
            for point in positions.chunks_exact(3) {
                soup.push_point(moved(matrix, [point[0], point[1], point[2]]));
            }
            let corners: Vec<u32> = match number(primitive, "indices") {
                Some(indices) => {
                    let numbers = self.numbers(indices, "SCALAR")?;
                    numbers.into_iter().map(|number| (number + first as f64) as u32).collect()
                }
                None => (first..first + count).map(|vertex| vertex as u32).collect(),
            };
            match (mode, &corners[..]) {
                (STRIP, corners) => push_strip(soup, corners),
                (FAN, [centre, rim @ ..]) => {
                    rim.windows(2).for_each(|pair| soup.push([*centre, pair[0], pair[1]]));
                }
                (_, corners) => {
                    corners.chunks_exact(3).for_each(|face| soup.push(face.iter().copied()));
                }
            }
        }
        Ok(())
    }

    /// The numbers of an accessor, which must have the given type.
    fn numbers(&self, accessor: usize, expected: &str) -> Result<Vec<f64>, String> {
        let accessor = list(&self.json, "accessors").get(accessor);
        let accessor = accessor.ok_or("names an accessor that does not exist")?;
        let components = if expected == "VEC3" { 3 } else { 1 };
        let kind = match accessor.get("componentType").and_then(Value::as_u64) {
            Some(5121) if components == 1 => Kind::U8,
            Some(5123) if components == 1 => Kind::U16,
            Some(5125) if components == 1 => Kind::U32,
            Some(5126) if components == 3 => Kind::F32,
            _ => return Err("has positions or indices of a type that is not read".to_owned()),
        };
        let is_expected = accessor.get("type").and_then(Value::as_str) == Some(expected);
        if !is_expected || accessor.get("sparse").is_some() {
            return Err("has a sparse accessor or one of an unexpected type".to_owned());
        }
        let view =
            number(accessor, "bufferView").and_then(|v| list(&self.json, "bufferViews").get(v));
        let view = view.ok_or("names a buffer view that does not exist")?;
        let buffer = number(view, "buffer").and_then(|buffer| self.buffers.get(buffer));
        let buffer = buffer.ok_or("names a buffer that does not exist")?;
        let size = components * kind.size();
        let step = number(view, "byteStride").unwrap_or(size).max(size);
        let start = [view, accessor].map(|part| number(part, "byteOffset").unwrap_or(0));
        let data = buffer.get(start[0].saturating_add(start[1])..).unwrap_or_default();
        let count = number(accessor, "count").unwrap_or(0);
        let needed = count.saturating_sub(1).saturating_mul(step).saturating_add(size);
        if count == 0 || needed > data.len() {
            return Err("has an accessor that is larger than its buffer".to_owned());
        }
        let items = (0..count).map(|item| &data[item * step..item * step + size]);
        let parts = items.flat_map(|item| item.chunks_exact(kind.size()));
        Ok(parts.map(|part| kind.decode(part, Order::Little)).collect())
    }
}

// === Transforms

fn numbers<const N: usize>(node: &Value, name: &str) -> Option<[f64; N]> {
    let numbers: Vec<f64> = node.get(name)?.as_array()?.iter().filter_map(Value::as_f64).collect();
    numbers.try_into().ok()
}

/// From a node's coordinates to those above it: a matrix, or scale, then rotation (a quaternion
/// x, y, z, w), then translation.
fn transform(node: &Value) -> Matrix {
    if let Some(matrix) = numbers(node, "matrix") {
        return matrix;
    }
    let [x, y, z, w] = numbers(node, "rotation").unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale: [f64; 3] = numbers(node, "scale").unwrap_or([1.0; 3]);
    let moved: [f64; 3] = numbers(node, "translation").unwrap_or([0.0; 3]);
    let axes = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
        [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
        [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
    ];
    std::array::from_fn(|i| match (i / 4, i % 4) {
        (3, 3) => 1.0,
        (_, 3) => 0.0,
        (3, row) => moved[row],
        (column, row) => axes[column][row] * scale[column],
    })
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| (0..4).map(|k| a[4 * k + i % 4] * b[4 * (i / 4) + k]).sum())
}

fn moved(matrix: &Matrix, point: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|row| {
        let turned: f64 = (0..3).map(|column| matrix[4 * column + row] * point[column]).sum();
        turned + matrix[12 + row]
    })
}
