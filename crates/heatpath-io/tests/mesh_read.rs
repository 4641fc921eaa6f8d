//! Meshes of every format: the same pyramid from each, and nothing but errors from damaged files.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

#[path = "common/meshes.rs"]
mod meshes;

use heatpath_io::{MeshFormat, ReadError, read_mesh, read_mesh_from_bytes};
use meshes::zoo;

fn error(bytes: &[u8], name: &str) -> String {
    let error = read_mesh_from_bytes(bytes, name).unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with(name) && !text.contains(char::is_control), "{text}");
    text
}

/// The pyramid is 2 x 2 x 1.5: each side has the area sqrt(1 + 1.5^2), and it points outwards.
fn assert_is_pyramid(bytes: &[u8], name: &str) {
    let file = read_mesh_from_bytes(bytes, name).unwrap();
    let cleaned = file.clean(file.usual_options()).unwrap();
    let (mesh, report) = (&cleaned.mesh, &cleaned.report);
    assert_eq!((mesh.points().len(), mesh.faces().len()), (5, 6), "{name}");
    assert_eq!((report.border_edges, report.inconsistent_edges), (0, 0), "{name}");
    assert_eq!((report.euler_characteristic, report.duplicates), (2, 0), "{name}");
    let volume: f64 = (0..6)
        .map(|face| {
            let [a, b, c] = mesh.corners(face);
            let cross: [f64; 3] = std::array::from_fn(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                b[j] * c[k] - b[k] * c[j]
            });
            a.iter().zip(cross).map(|(a, c)| a * c).sum::<f64>() / 6.0
        })
        .sum();
    assert!((volume - 2.0).abs() < 1e-12, "{name}: volume {volume}");
}

#[test]
fn all_formats_hold_the_same_pyramid() {
    for (name, bytes) in zoo() {
        assert_is_pyramid(&bytes, name);
    }
}

#[test]
fn content_decides_where_it_can() {
    for (name, bytes) in zoo() {
        let usual = read_mesh_from_bytes(&bytes, name).unwrap().format;
        assert_eq!(read_mesh_from_bytes(&bytes, "pyramid.dat").unwrap().format, usual, "{name}");
    }
    let without_name = b"3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_eq!(read_mesh_from_bytes(without_name, "a.OFF").unwrap().format, MeshFormat::Off);
    assert!(error(without_name, "a.dat").contains("PLY, OBJ, STL, OFF"));
}

#[test]
fn vertices_keep_the_numbers_of_the_file() {
    for (name, bytes) in
        zoo().iter().filter(|(name, _)| !name.contains("stl") && !name.contains("gl"))
    {
        let file = read_mesh_from_bytes(bytes, name).unwrap();
        let expected: Vec<[f64; 3]> = meshes::POINTS.iter().map(|p| p.map(f64::from)).collect();
        assert_eq!(file.soup.points(), expected, "{name}");
    }
}

#[test]
fn scalars_and_colours_come_along() {
    for (name, bytes) in zoo() {
        let file = read_mesh_from_bytes(&bytes, name).unwrap();
        if name.contains("ply") || name.contains("vt") {
            let (array, values) = &file.arrays[0];
            assert!(array.ends_with("height"), "{name}: {array}");
            assert_eq!(values, &[0.0, 0.0, 0.0, 0.0, 1.5], "{name}");
        }
        let colours = (name == "text.ply").then(|| vec![[10, 20, 30]; 5]);
        assert_eq!(file.colours, colours, "{name}");
    }
    let text = read_mesh_from_bytes(&meshes::vtk_text(), "text.vtk").unwrap();
    let names: Vec<&str> = text.arrays.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["the height", "id"]);
    let coloured = b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n";
    let coloured = read_mesh_from_bytes(coloured, "a.obj").unwrap();
    assert_eq!(coloured.colours.unwrap(), [[255, 0, 0], [0, 255, 0], [0, 0, 128]]);
}

#[test]
fn truncated_files_are_errors_or_whole() {
    for (name, bytes) in zoo() {
        for length in 0..bytes.len() {
            let Ok(file) = read_mesh_from_bytes(&bytes[..length], name) else { continue };
            // Lists without counts may end early; all others must be whole.
            let is_open = name.ends_with("obj") || name.ends_with("vtk");
            let polygons = file.soup.polygons().len();
            assert!(is_open || polygons >= 5, "{name} cut at {length}: {polygons} polygons");
        }
    }
}

#[test]
fn flipped_bits_never_panic() {
    for (name, bytes) in zoo() {
        for bit in 0..8 * bytes.len() {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            match read_mesh_from_bytes(&damaged, name) {
                Ok(file) => {
                    let options = file.usual_options();
                    if let Err(error) = file.clean(options) {
                        assert!(matches!(error, ReadError::Clean { .. }), "{name}: {error}");
                    }
                }
                Err(error) => assert!(!error.to_string().contains(char::is_control), "{error}"),
            }
        }
    }
}

#[test]
fn counts_that_lie_are_refused_without_allocating() {
    let ply = |format: &str, rest: &str| {
        let text = format!("ply\nformat {format} 1.0\n{rest}end_header\n1 2 3 4 5 6 7 8 9\n");
        error(text.as_bytes(), "a.ply")
    };
    let vertices =
        "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        assert!(ply(format, vertices).contains("ends too early"));
        assert!(ply(format, "element vertex 4000000000000\n").contains("no x, y and z"));
        let faces = "element face 4000000000\nproperty list uint uint vertex_indices\n";
        assert!(ply(format, faces).contains("a.ply"));
    }
    let mut stl = meshes::stl_binary();
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    stl[0] = b'x';
    assert!(error(&stl, "a.stl").contains("ends too early"));
    assert!(error(b"OFF\n99999999999 9 0\n0 0 0\n", "a.off").contains("ends too early"));
    assert!(error(b"OFF\n1 1 0\n0 0 0\n18446744073709551615 0\n", "a.off").contains("too early"));
    let vtk = b"# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\nPOINTS 99999999999 float\n";
    assert!(error(vtk, "a.vtk").contains("ends too early"));
    let mut surface = meshes::freesurfer();
    surface[22..30].fill(0x7f);
    assert!(error(&surface, "lh.white").contains("ends too early"));
}

/// What claims to grow to more than zlib can do is not even begun.
#[test]
fn arrays_that_grow_beyond_the_file_are_refused() {
    let head = [1_u64, 1 << 40, 0, 11];
    let mut file =
        b"<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\
        <PolyData><Piece><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" \
        format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>\
        <AppendedData encoding=\"raw\">_"
            .to_vec();
    file.extend(head.iter().flat_map(|count| count.to_le_bytes()));
    file.extend([0; 11]);
    assert!(error(&file, "a.vtp").contains("larger than it can hold"));
}

#[test]
fn broken_meshes_are_named() {
    assert!(error(b"v 0 0 0\nv 1 0 0\nf 1 2 x\n", "a.obj").contains("line 3: expected a number"));
    assert!(error(b"v 0 0 0\nf 1 0 1\n", "a.obj").contains("line 2: a face uses vertex 0 of 1"));
    assert!(error(b"v 0 0\n", "a.obj").contains("line 1: a vertex needs three numbers"));
    assert!(error(b"4OFF\n1 1 0\n", "a.off").contains("other dimensions"));
    assert!(error(b"OFF BINARY\n1 1 0\n", "a.off").contains("binary files are not read"));
    assert!(
        error(
            b"{\"asset\": {}, \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]}",
            "a.gltf"
        )
        .contains("KHR_draco_mesh_compression")
    );
    let external = b"{\"asset\": {}, \"buffers\": [{\"uri\": \"a.bin\"}]}";
    assert!(error(external, "a.gltf").contains("in another file"));
    let loops =
        b"{\"asset\": {}, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"children\": [0]}]}";
    assert!(error(loops, "a.gltf").contains("two parents"));
    let missing = read_mesh("no/such/file.ply").unwrap_err();
    assert!(missing.is_access());
    let lost = read_mesh_from_bytes(b"v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\n", "a.obj").unwrap();
    let text = lost.clean(lost.usual_options()).unwrap_err().to_string();
    assert!(text.starts_with("a.obj: vertex 2 lies at [NaN, 0.0, 0.0]"), "{text}");
}

/// Two triangles of a file of 32-bit floats whose common corners differ in the last bit.
#[test]
fn stl_is_welded_within_rounding() {
    let next = |x: f32| f32::from_bits(x.to_bits() + 1);
    let triangles = [
        [[10.0_f32, 0.1, 0.0], [0.3, 7.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.3, next(7.0), 0.0], [next(10.0), 0.1, 0.0], [0.0, 0.0, -1.0]],
    ];
    let mut file = vec![0; 80];
    file.extend(2_u32.to_le_bytes());
    for triangle in triangles {
        file.extend([0; 12]);
        triangle.iter().flatten().for_each(|x| file.extend(x.to_le_bytes()));
        file.extend([0; 2]);
    }
    let file = read_mesh_from_bytes(&file, "a.stl").unwrap();
    let cleaned = file.clean(file.usual_options()).unwrap();
    assert_eq!((cleaned.report.welded, cleaned.report.border_edges), (2, 4));
    assert_eq!(cleaned.vertices, [0, 1, 2, 1, 0, 3]);
}
