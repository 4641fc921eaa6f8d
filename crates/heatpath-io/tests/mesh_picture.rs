//! Pictures of meshes: the right colours at known places, and one picture as a whole.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::mesh::TriMesh;
use heatpath_core::mesh::path::{Ending, Path};
use heatpath_core::mesh::shapes::{icosphere, sheet, torus};
use heatpath_io::colour::viridis;
use heatpath_io::{MeshPicture, Up, View, render_mesh, write_mesh_picture};
use image::{Rgb, RgbImage, RgbaImage};
use std::f64::consts::TAU;
use tempfile::tempdir;

/// From straight above a sheet with x to the right and y upwards.
const FRONT: View = View::Angles { up: Up::Y, azimuth: 0.0, elevation: 0.0 };

/// Fills 92 % of a picture of 100 x 100 pixels: a unit is 9.2 pixels.
fn square() -> TriMesh {
    sheet(10, 10, |x, y| [x as f64, y as f64, 0.0])
}

fn picture() -> MeshPicture<'static> {
    MeshPicture { size: [100, 100], view: FRONT, ..Default::default() }
}

fn path(positions: &[[f64; 3]], ending: Ending) -> Path {
    let (points, positions) = (Vec::new(), positions.to_vec());
    Path { points, positions, ending, length: 1.0, distance: 1.0 }
}

fn at(image: &RgbaImage, [x, y]: [f64; 2]) -> [u8; 4] {
    image.get_pixel((4.0 + 9.2 * x) as u32, (96.0 - 9.2 * y) as u32).0
}

#[test]
fn values_have_their_colours() {
    let mesh = square();
    let mut values: Vec<f64> = mesh.points().iter().map(|[x, _, _]| 3.0 + x).collect();
    values[11 * 5 + 5] = f64::INFINITY;
    let drawn = render_mesh(&mesh, &MeshPicture { values: Some(&values), ..picture() }).unwrap();
    for x in [0.5, 2.5, 9.5] {
        let expected = viridis(x / 10.0);
        let found = at(&drawn, [x, 2.0]);
        assert!((0..3).all(|c| found[c].abs_diff(expected[c]) <= 3), "{x}: {found:?}");
    }
    assert_eq!(at(&drawn, [5.0, 5.0]), [64, 64, 64, 255]);
    assert_eq!(drawn.get_pixel(1, 1).0[3], 0);
    assert_eq!(drawn.get_pixel(3, 50).0[3], 0);
}

#[test]
fn lines_of_equal_value_lie_where_they_should() {
    let mesh = square();
    let values: Vec<f64> = mesh.points().iter().map(|[x, _, _]| *x).collect();
    let lines = MeshPicture { values: Some(&values), isolines: 4, ..picture() };
    let drawn = render_mesh(&mesh, &lines).unwrap();
    let sum = |colour: &[u8]| colour[..3].iter().map(|&c| u32::from(c)).sum::<u32>();
    let plain = |x: u32| sum(&viridis((f64::from(x) + 0.5 - 4.0) / 92.0));
    let is_dark = |x: u32| 4 * sum(&drawn.get_pixel(x, 30).0) < 3 * plain(x);
    let dark: Vec<u32> = (40..90).filter(|&x| is_dark(x)).collect();
    // 4 + 9.2 x of x = 5 and 7.5.
    assert!(dark.iter().all(|&x| (49..=51).contains(&x) || (72..=73).contains(&x)), "{dark:?}");
    assert!(dark.iter().any(|&x| x < 60) && dark.iter().any(|&x| x > 60), "{dark:?}");
}

#[test]
fn paths_ends_and_sources_are_drawn() {
    let paths = [
        path(&[[1.0, 8.0, 0.0], [5.0, 8.0, 0.0], [9.0, 8.0, 0.0]], Ending::Source(0)),
        path(&[[1.0, 5.0, 0.0], [9.0, 5.0, 0.0]], Ending::Stuck),
        path(&[[5.0, 1.0, 0.0]], Ending::Unreachable),
    ];
    let marks = MeshPicture { paths: &paths, sources: &[[8.0, 2.0, 0.0]], ..picture() };
    let drawn = render_mesh(&square(), &marks).unwrap();
    let [r, g, b, _] = at(&drawn, [5.0, 8.0]);
    assert!(r < 60 && g > 160 && b > 200, "a path is cyan: {:?}", at(&drawn, [5.0, 8.0]));
    let orange = |&x: &f64| matches!(at(&drawn, [x, 5.0]), [200..=255, 100..200, 0..100, _]);
    let dashes = (15..85).map(|x| f64::from(x) / 10.0).filter(orange).count();
    assert!((20..60).contains(&dashes), "dashes: {dashes} of 70");
    for end in [[1.0, 8.0], [1.0, 5.0], [5.0, 1.0]] {
        assert_eq!(at(&drawn, end), [255; 4], "the end at {end:?}");
    }
    for source in [[9.0, 8.0], [8.0, 2.0]] {
        assert!(
            matches!(at(&drawn, source), [200..=255, 0..60, 0..60, _]),
            "the source at {source:?}"
        );
    }
}

#[test]
fn what_lies_behind_is_hidden() {
    let behind = [path(&[[1.0, 5.0, -5.0], [9.0, 5.0, -5.0]], Ending::Source(0))];
    let marks = MeshPicture { paths: &behind, ..picture() };
    assert_eq!(
        render_mesh(&square(), &marks).unwrap(),
        render_mesh(&square(), &picture()).unwrap()
    );
    // From the other side it is in front.
    let back = View::Angles { up: Up::Y, azimuth: 180.0, elevation: 0.0 };
    let drawn = render_mesh(&square(), &MeshPicture { view: back, ..marks }).unwrap();
    assert!(at(&drawn, [5.0, 5.0])[2] > 200 && at(&drawn, [5.0, 5.0])[0] < 60);
}

#[test]
fn odd_meshes_and_paths_do_no_harm() {
    let point = TriMesh::new(vec![[1.0; 3]; 3], vec![[0, 1, 2]]).unwrap();
    let needle = TriMesh::new(vec![[0.0; 3], [1.0; 3], [2.0; 3]], vec![[0, 1, 2]]).unwrap();
    let vast = sheet(2, 2, |x, y| [1e99 * x as f64, 1e99 * y as f64, 0.0]);
    let tiny = sheet(2, 2, |x, y| [1e-99 * x as f64, 1e-99 * y as f64, 0.0]);
    let wild = [path(&[[f64::NAN; 3], [1e300, -1e300, 0.0], [f64::INFINITY; 3]], Ending::Stuck)];
    for (number, mesh) in [point, needle, vast, tiny].iter().enumerate() {
        let values = vec![f64::MAX, f64::MIN, f64::NAN]
            .into_iter()
            .cycle()
            .take(mesh.points().len())
            .collect::<Vec<_>>();
        for size in [[1, 1], [40, 30]] {
            let odd = MeshPicture {
                size,
                values: Some(&values),
                isolines: 3,
                paths: &wild,
                ..Default::default()
            };
            let drawn = render_mesh(mesh, &odd).unwrap();
            assert_eq!(drawn.dimensions(), (size[0] as u32, size[1] as u32));
            let plain = render_mesh(
                mesh,
                &MeshPicture { view: FRONT, size: [40, 30], ..Default::default() },
            )
            .unwrap();
            assert!(number < 2 || plain.pixels().any(|pixel| pixel.0[3] > 0));
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let (mesh, values) = (square(), [1.0]);
    let text = |picture: &MeshPicture<'_>| render_mesh(&mesh, picture).unwrap_err().to_string();
    let text_of_size = text(&MeshPicture { size: [0, 5000], ..picture() });
    assert_eq!(text_of_size, "a picture of 0 x 5000 pixels; from 1 to 4096 a side can be drawn");
    let text_of_values = text(&MeshPicture { values: Some(&values), ..picture() });
    assert_eq!(text_of_values, "1 values were given for 121 vertices");
    let view = View::Angles { up: Up::Z, azimuth: f64::NAN, elevation: 0.0 };
    assert!(text(&MeshPicture { view, ..picture() }).contains("must be finite"));
    let folder = tempdir().unwrap();
    let file = folder.path().join("mesh.jpg");
    assert!(write_mesh_picture(&file, false, &mesh, &picture(), None).is_err());
}

#[test]
fn files_have_a_bar_beside_the_mesh() {
    let (folder, mesh) = (tempdir().unwrap(), icosphere(3));
    let file = folder.path().join("mesh.png");
    let values: Vec<f64> = mesh.points().iter().map(|point| point[1]).collect();
    let drawing = MeshPicture { values: Some(&values), ..picture() };
    write_mesh_picture(&file, false, &mesh, &drawing, Some("heights")).unwrap();
    let image = image::open(&file).unwrap().into_rgb8();
    assert!(image.width() > 140 && image.height() == 24 + 100);
    assert_eq!(image.get_pixel(2, 60).0, [255; 3]);
    assert_eq!(image.get_pixel(120, 24 + 8).0, viridis(1.0));
}

/// A torus with the angle around its tube, lines of it, and a path half around: as in
/// `docs/figures`, which `HEATPATH_BLESS=1` draws anew.
#[test]
fn a_torus_is_drawn_as_before() {
    let mesh = torus(2.0, 0.9, 96, 48);
    let values: Vec<f64> = (0..48 * 96).map(|i| (TAU * f64::from(i / 96) / 48.0).cos()).collect();
    let around = |i: usize| mesh.points()[96 * 12 + i];
    let paths = [path(&(0..49).map(around).collect::<Vec<_>>(), Ending::Source(0))];
    let view = View::Angles { up: Up::Z, azimuth: 21.0, elevation: 47.0 };
    let drawing = MeshPicture {
        size: [160, 120],
        view,
        values: Some(&values),
        isolines: 8,
        paths: &paths,
        ..Default::default()
    };
    let drawn = render_mesh(&mesh, &drawing).unwrap();
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/figures/mesh.png");
    if std::env::var_os("HEATPATH_BLESS").is_some() {
        drawn.save(file).unwrap();
        return;
    }
    let expected = image::open(file).unwrap().into_rgba8();
    assert_eq!(expected.dimensions(), drawn.dimensions());
    let mut difference = RgbImage::new(drawn.width(), drawn.height());
    for (pixel, (a, b)) in difference.pixels_mut().zip(expected.pixels().zip(drawn.pixels())) {
        *pixel = Rgb(std::array::from_fn(|c| a[c].abs_diff(b[c]).max(a[3].abs_diff(b[3]))));
    }
    // Sines may differ in the last bit from one mathematical library to another.
    if difference.pixels().any(|pixel| pixel.0.iter().any(|&d| d > 3)) {
        let left = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
        drawn.save(left.join("mesh_drawn.png")).unwrap();
        difference.save(left.join("mesh_difference.png")).unwrap();
        panic!("the torus is drawn differently; see {}", left.display());
    }
}
