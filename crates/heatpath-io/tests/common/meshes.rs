//! A pyramid in every format: 5 points, a square and 4 triangles, and the height of each point.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

pub(crate) const POINTS: [[f32; 3]; 5] =
    [[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [0., 2., 0.], [1., 1., 1.5]];
const SIDES: [[u32; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
/// The base in two, as STL and strips need it.
const BASE: [[u32; 3]; 2] = [[0, 3, 2], [0, 2, 1]];

fn triangles() -> impl Iterator<Item = [u32; 3]> {
    SIDES.into_iter().chain(BASE)
}

fn text_of_points() -> String {
    POINTS.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect()
}

fn polygons(first: u32) -> String {
    let sides =
        SIDES.iter().map(|[a, b, c]| format!("3 {} {} {}\n", a + first, b + first, c + first));
    let base = [0, 3, 2, 1].map(|vertex| (vertex + first).to_string()).join(" ");
    sides.collect::<String>() + "4 " + &base + "\n"
}

pub(crate) fn ply_text() -> Vec<u8> {
    let vertices: String =
        POINTS.iter().map(|[x, y, z]| format!("{x} {y} {z} 10 20 30 {z}\n")).collect();
    format!(
        "ply\nformat ascii 1.0\ncomment a pyramid\nelement vertex 5\nproperty float x\n\
         property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
         property uchar blue\nproperty double height\nelement face 5\n\
         property list uchar int vertex_indices\nend_header\n{vertices}{}",
        polygons(0)
    )
    .into_bytes()
}

pub(crate) fn ply_binary(is_big: bool, strips: bool) -> Vec<u8> {
    let order = if is_big { "big" } else { "little" };
    let faces = if strips {
        "element tristrips 1\nproperty list int int vertex_indices"
    } else {
        "element face 6\nproperty uchar flag\nproperty list uchar ushort vertex_index"
    };
    let mut out = format!(
        "ply\r\nformat binary_{order}_endian 1.0\r\nelement vertex 5\r\nproperty double height\r\n\
         property float x\r\nproperty float y\r\nproperty float z\r\n{faces}\r\nend_header\r\n"
    )
    .into_bytes();
    fn put<const N: usize>(out: &mut Vec<u8>, is_big: bool, mut little: [u8; N]) {
        if is_big {
            little.reverse();
        }
        out.extend(little);
    }
    for point in POINTS {
        put(&mut out, is_big, f64::from(point[2]).to_le_bytes());
        point.iter().for_each(|x| put(&mut out, is_big, x.to_le_bytes()));
    }
    if strips {
        // Two strips: round the tip and on, and the rest.
        let strip = [0, 1, 4, 2, 3, -1, 3, 0, 4, -1, 0, 3, 1, 2];
        put(&mut out, is_big, (strip.len() as i32).to_le_bytes());
        strip.iter().for_each(|vertex: &i32| put(&mut out, is_big, vertex.to_le_bytes()));
        return out;
    }
    for face in triangles() {
        out.extend([7, 3]);
        face.iter().for_each(|&vertex| put(&mut out, is_big, (vertex as u16).to_le_bytes()));
    }
    out
}

pub(crate) fn obj() -> Vec<u8> {
    let points: String = POINTS.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    format!(
        "# a pyramid\nmtllib none.mtl\no pyramid\n{points}vt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1 2/2 5/1\n\
         f 2/1/1 3/2/1 5/1/1\nf 3//1 4//1 \\\n 5//1\nf -2 -5 -1\ng base\nf 1 4 3 2 # a square\nl 1 2\n"
    )
    .into_bytes()
}

pub(crate) fn stl_text() -> Vec<u8> {
    let facet = |face: [u32; 3]| {
        let corner = |vertex: u32| {
            let [x, y, z] = POINTS[vertex as usize];
            format!("    vertex {x} {y:e} {z}\n")
        };
        let corners: String = face.into_iter().map(corner).collect();
        format!("facet normal 0 0 0\n  outer loop\n{corners}  endloop\nendfacet\n")
    };
    format!("solid vertex of a pyramid\n{}endsolid\n", triangles().map(facet).collect::<String>())
        .into_bytes()
}

/// Some programs begin binary files with `solid`.
pub(crate) fn stl_binary() -> Vec<u8> {
    let mut out = b"solid but binary".to_vec();
    out.resize(80, b' ');
    out.extend(6_u32.to_le_bytes());
    for face in triangles() {
        out.extend([0; 12]);
        for vertex in face {
            POINTS[vertex as usize].iter().for_each(|x| out.extend(x.to_le_bytes()));
        }
        out.extend([0; 2]);
    }
    out
}

pub(crate) fn off() -> Vec<u8> {
    format!("OFF 5 5 0\n# points\n{}\n# faces\n{}", text_of_points(), polygons(0)).into_bytes()
}

/// Normals and colours of vertices, colours of faces, and a face over several lines.
pub(crate) fn coff() -> Vec<u8> {
    let points: String =
        POINTS.iter().map(|[x, y, z]| format!("{x} {y} {z} 0 0 1 0.5 0.5 0.5 1\n")).collect();
    format!("CNOFF\n5 5 8\n{points}{}", polygons(0).replace("3 0 1 4", "3 0\n1\n4 255 0 0"))
        .into_bytes()
}

pub(crate) fn vtk_text() -> Vec<u8> {
    format!(
        "# vtk DataFile Version 3.0\na pyramid\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n{}\
         LINES 1 3\n2 0 1\nPOLYGONS 5 21\n{}POINT_DATA 5\nSCALARS the%20height double\n\
         LOOKUP_TABLE default\n0 0 0 0 1.5\nVECTORS v float\n{}FIELD FieldData 1\nid 1 5 int\n\
         1 2 3 4 5\nCELL_DATA 6\nSCALARS area float 1\nLOOKUP_TABLE default\n1 2 3 4 5 6\n",
        text_of_points(),
        polygons(0),
        "1 2 3\n".repeat(5)
    )
    .into_bytes()
}

/// The layout since version 5: offsets and connectivity.
pub(crate) fn vtk_binary() -> Vec<u8> {
    let mut out = b"# vtk DataFile Version 5.1\na pyramid\nBINARY\nDATASET POLYDATA\n\
                    POINTS 5 float\n"
        .to_vec();
    POINTS.iter().flatten().for_each(|x| out.extend(x.to_be_bytes()));
    out.extend(b"\nMETADATA\nINFORMATION 0\n\nPOLYGONS 2 4\nOFFSETS vtktypeint64\n");
    [0_i64, 4].iter().for_each(|end| out.extend(end.to_be_bytes()));
    out.extend(b"\nCONNECTIVITY vtktypeint64\n");
    [0_i64, 3, 2, 1].iter().for_each(|vertex| out.extend(vertex.to_be_bytes()));
    out.extend(b"\nTRIANGLE_STRIPS 2 10\n");
    [5_i32, 0, 1, 4, 2, 3, 3, 3, 0, 4].iter().for_each(|part| out.extend(part.to_be_bytes()));
    out.extend(b"\nPOINT_DATA 5\nSCALARS height double\nLOOKUP_TABLE default\n");
    [0.0_f64, 0.0, 0.0, 0.0, 1.5].iter().for_each(|z| out.extend(z.to_be_bytes()));
    out.push(b'\n');
    out
}

/// How the arrays of a VTP file are written.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Arrays {
    Text,
    Base64,
    Zlib,
    Appended,
    AppendedBase64,
}

pub(crate) fn vtp(arrays: Arrays) -> Vec<u8> {
    let points: Vec<u8> = POINTS.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let heights: Vec<u8> = POINTS.iter().flat_map(|p| f64::from(p[2]).to_le_bytes()).collect();
    let numbers = |list: &[i32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let corners = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 3, 2, 1];
    let ends = [3, 6, 9, 12, 16];
    let words = |list: &[i32]| list.iter().map(|x| format!("{x} ")).collect::<String>();
    let mut appended = Vec::new();
    let mut array = |kind: &str, name: &str, components: usize, data: &[u8], text: String| {
        let piece = [&(data.len() as u64).to_le_bytes()[..], data].concat();
        let (format, inside) = match arrays {
            Arrays::Text => ("ascii\"".to_owned(), text),
            Arrays::Base64 => ("binary\"".to_owned(), base64(&piece)),
            Arrays::Zlib => ("binary\"".to_owned(), zlib(data)),
            Arrays::Appended | Arrays::AppendedBase64 => {
                let place = format!("appended\" offset=\"{}\"", appended.len());
                let is_raw = arrays == Arrays::Appended;
                appended.extend(if is_raw { piece } else { base64(&piece).into_bytes() });
                (place, String::new())
            }
        };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"{format}>\n{inside}\n</DataArray>\n"
        )
    };
    let body = format!(
        "<PolyData><Piece NumberOfPoints=\"5\" NumberOfPolys=\"5\">\n<PointData>{}</PointData>\n\
         <Points>{}</Points>\n<Polys>{}{}</Polys>\n</Piece></PolyData>\n",
        array("Float64", "height", 1, &heights, "0 0 0 0 1.5".to_owned()),
        array("Float32", "Points", 3, &points, text_of_points()),
        array("Int32", "connectivity", 1, &numbers(&corners), words(&corners)),
        array("Int32", "offsets", 1, &numbers(&ends), words(&ends)),
    );
    let compressor =
        if arrays == Arrays::Zlib { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt64\"{compressor}>\n{body}"
    )
    .into_bytes();
    if !appended.is_empty() {
        let encoding = if arrays == Arrays::Appended { "raw" } else { "base64" };
        out.extend(format!("<AppendedData encoding=\"{encoding}\">\n _").into_bytes());
        out.extend(appended);
        out.extend(b"\n</AppendedData>\n");
    }
    out.extend(b"</VTKFile>\n");
    out
}

/// Two blocks: the first one of 16 bytes, the last one of what is left.
fn zlib(data: &[u8]) -> String {
    let (first, last) = data.split_at(16);
    let packed = [first, last].map(|block| {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(block).unwrap();
        encoder.finish().unwrap()
    });
    let head = [2, 16, last.len(), packed[0].len(), packed[1].len()];
    let head: Vec<u8> = head.iter().flat_map(|&count| (count as u64).to_le_bytes()).collect();
    base64(&head) + &base64(&packed.concat())
}

fn base64(bytes: &[u8]) -> String {
    use base64::Engine;
    base64::engine::general_purpose::STANDARD.encode(bytes)
}

/// Two nodes: the sides as a fan, the base, moved back by its node, as separate triangles without
/// indices. The parent doubles all coordinates that the file halves.
pub(crate) fn gltf(is_binary: bool) -> Vec<u8> {
    let half = |vertex: u32| POINTS[vertex as usize].map(|x| x / 2.0);
    let mut data: Vec<u8> = (0..5).flat_map(half).flat_map(f32::to_le_bytes).collect();
    data.extend([4, 0, 1, 2, 3, 0, 0, 0]);
    let base = BASE.iter().flatten().map(|&vertex| half(vertex));
    data.extend(base.flat_map(|[x, y, z]| [x, y, z - 4.0]).flat_map(f32::to_le_bytes));
    let uri = format!("\"uri\": \"data:application/octet-stream;base64,{}\", ", base64(&data));
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"children": [1, 2], "scale": [2, 2, 2]}}, {{"mesh": 0}},
                  {{"mesh": 1, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,4,1]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "mode": 6}},
                                    {{"attributes": {{"POSITION": 0}}, "mode": 0}}]}},
                   {{"primitives": [{{"attributes": {{"POSITION": 2}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"}},
                      {{"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}},
                      {{"bufferView": 2, "componentType": 5126, "count": 6, "type": "VEC3"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 60}},
                        {{"buffer": 0, "byteOffset": 60, "byteLength": 8}},
                        {{"buffer": 0, "byteOffset": 68, "byteLength": 72, "byteStride": 12}}],
        "buffers": [{{{}"byteLength": {}}}]}}"#,
        if is_binary { "" } else { &uri },
        data.len()
    );
    if !is_binary {
        return json.into_bytes();
    }
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = (12 + 8 + json.len() + 8 + data.len()) as u32;
    let mut out = [&b"glTF\x02\0\0\0"[..], &length.to_le_bytes()].concat();
    for (name, chunk) in [(b"JSON", &json), (b"BIN\0", &data)] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend(name);
        out.extend(chunk);
    }
    out
}

pub(crate) fn freesurfer() -> Vec<u8> {
    let mut out = b"\xff\xff\xfecreated by a test\n\n".to_vec();
    out.extend([5_i32, 6].iter().flat_map(|count| count.to_be_bytes()));
    out.extend(POINTS.iter().flatten().flat_map(|x| x.to_be_bytes()));
    out.extend(triangles().flatten().flat_map(|vertex| (vertex as i32).to_be_bytes()));
    out
}

/// All of them, with names that have the usual endings.
pub(crate) fn zoo() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("text.ply", ply_text()),
        ("little.ply", ply_binary(false, false)),
        ("big.ply", ply_binary(true, false)),
        ("strips.ply", ply_binary(false, true)),
        ("pyramid.obj", obj()),
        ("text.stl", stl_text()),
        ("binary.stl", stl_binary()),
        ("pyramid.off", off()),
        ("colours.off", coff()),
        ("text.vtk", vtk_text()),
        ("binary.vtk", vtk_binary()),
        ("text.vtp", vtp(Arrays::Text)),
        ("base64.vtp", vtp(Arrays::Base64)),
        ("zlib.vtp", vtp(Arrays::Zlib)),
        ("appended.vtp", vtp(Arrays::Appended)),
        ("appended_base64.vtp", vtp(Arrays::AppendedBase64)),
        ("pyramid.glb", gltf(true)),
        ("pyramid.gltf", gltf(false)),
        ("lh.pial", freesurfer()),
    ]
}
