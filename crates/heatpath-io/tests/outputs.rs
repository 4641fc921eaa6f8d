//! Outputs appear complete or not at all, and fields come back as they were.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use heatpath_core::grid::{Grid, Shape};
use heatpath_io::{
    FieldFormat, FieldStyle, WriteError, check_dimension, check_output, info, read_field,
    read_mask, remove_leftovers, write_atomically, write_field, write_mask,
};
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use tempfile::{TempDir, tempdir};

fn names(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

fn hello(out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"hello")
}

fn some_field() -> Grid<f64, 2> {
    let values = vec![0.1, -2.5, f64::INFINITY, 1e300, 5.0, 6.0];
    Grid::from_values(Shape::new([3, 2]).unwrap(), values).unwrap()
}

#[test]
fn a_failed_write_leaves_nothing_behind() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let failing = |out: &mut dyn Write| {
        out.write_all(&[0; 100_000])?;
        Err(io::Error::other("no more ink"))
    };
    let error = write_atomically(&path, false, failing).unwrap_err();
    assert!(error.to_string().ends_with("a.txt: cannot be written: no more ink"), "{error}");
    assert!(names(&folder).is_empty());
    write_atomically(&path, false, hello).unwrap();
    write_atomically(&path, true, failing).unwrap_err();
    assert_eq!(
        (names(&folder), fs::read(&path).unwrap()),
        (vec!["a.txt".to_owned()], b"hello".to_vec())
    );
}

#[test]
fn existing_files_are_overwritten_on_request_only() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let error = write_atomically(&path, false, hello).unwrap_err();
    assert!(
        matches!(error, WriteError::Exists { .. }) && error.to_string().ends_with("already exists")
    );
    assert!(matches!(check_output(&path, None, false, &["txt"]), Err(WriteError::Exists { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"old");
    check_output(&path, None, true, &["txt"]).unwrap();
    write_atomically(&path, true, hello).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"hello");
    assert_eq!(names(&folder), ["a.txt"]);
}

#[test]
fn a_file_that_appears_meanwhile_is_kept() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let racing = |out: &mut dyn Write| {
        fs::write(&path, "first")?;
        hello(out)
    };
    let error = write_atomically(&path, false, racing).unwrap_err();
    assert!(matches!(error, WriteError::Exists { .. }), "{error}");
    assert_eq!(fs::read(&path).unwrap(), b"first");
    assert_eq!(names(&folder), ["a.txt"]);
}

#[test]
fn folders_and_endings_are_checked() {
    let folder = tempdir().unwrap();
    let missing = folder.path().join("no/a.npy");
    for result in
        [write_atomically(&missing, true, hello), check_output(&missing, None, false, &["npy"])]
    {
        let error = result.unwrap_err();
        assert!(
            matches!(&error, WriteError::FolderMissing { folder, .. } if folder.ends_with("no"))
        );
    }
    let error =
        check_output(folder.path().join("a.gif"), None, false, &["npy", "tif"]).unwrap_err();
    assert!(
        error.to_string().ends_with("unknown ending or format; accepted are .npy, .tif"),
        "{error}"
    );
    let error = write_atomically(folder.path(), true, hello).unwrap_err();
    assert!(matches!(error, WriteError::IsFolder { .. }));
    check_output(folder.path().join("A.NPY"), None, false, &["npy"]).unwrap();
    check_output("no-folder-given.npy", None, false, &["npy"]).unwrap();
    assert!(names(&folder).is_empty());
}

#[cfg(unix)]
#[test]
fn links_permissions_and_devices() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    // As any new file.
    fs::write(at("plain"), "").unwrap();
    write_atomically(at("new"), false, hello).unwrap();
    assert_eq!(mode(&at("new")), mode(&at("plain")));
    // As it was.
    fs::set_permissions(at("new"), PermissionsExt::from_mode(0o640)).unwrap();
    symlink("new", at("link")).unwrap();
    assert!(matches!(write_atomically(at("link"), false, hello), Err(WriteError::Exists { .. })));
    write_atomically(at("link"), true, |out| out.write_all(b"through the link")).unwrap();
    assert!(at("link").is_symlink());
    assert_eq!(
        (fs::read(at("new")).unwrap(), mode(&at("new"))),
        (b"through the link".to_vec(), 0o640)
    );
    // A link that leads nowhere.
    symlink("nowhere", at("dangling")).unwrap();
    assert!(matches!(
        write_atomically(at("dangling"), false, hello),
        Err(WriteError::Exists { .. })
    ));
    // A device is still one afterwards.
    write_atomically("/dev/null", true, hello).unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

#[test]
fn fields_come_back() {
    let folder = tempdir().unwrap();
    let field = some_field();
    let at = |name: &str| folder.path().join(name);
    write_field(at("a.npy"), None, false, &field, &FieldStyle::default()).unwrap();
    assert_eq!(read_field(at("a.npy"), [1.0, 1.0]).unwrap(), field);
    let bytes = fs::read(at("a.npy")).unwrap();
    let header = String::from_utf8_lossy(&bytes);
    assert!(header.contains("'<f8'") && header.contains("False") && header.contains("(2, 3"));
    for name in ["a.tif", "b.TIFF"] {
        write_field(at(name), None, false, &field, &FieldStyle::default()).unwrap();
        let expected = field.map(|&value| f64::from(value as f32));
        assert_eq!(read_field(at(name), [1.0, 1.0]).unwrap(), expected);
        assert_eq!(info(at(name)).unwrap().sample.to_string(), "float32");
    }
    let error = write_field(at("a.npy"), None, false, &field, &FieldStyle::default()).unwrap_err();
    assert!(matches!(error, WriteError::Exists { .. }));
    let error = write_field(at("a.bmp"), None, false, &field, &FieldStyle::default()).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with(".npy, .tif, .tiff, .png, .nrrd, .nhdr, .mha, .mhd, .nii, .nii.gz")
    );
    assert_eq!(FieldFormat::new("x.y.PNG", None).unwrap(), FieldFormat::Png);
    assert_eq!(FieldFormat::new("x.NII.gz", None).unwrap(), FieldFormat::NiftiGz);
    assert!(FieldFormat::new("x.gz", None).is_err());
}

#[test]
fn fields_of_volumes_are_no_pictures() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let volume = Grid::from_fn(Shape::new([3, 2, 2]).unwrap(), |[x, y, z]| (x + y + z) as f64);
    for (name, format) in [("a.png", None), ("a.npy", Some("PNG"))] {
        let error = write_field(at(name), format, false, &volume, &FieldStyle::default());
        let error = error.unwrap_err().to_string();
        assert!(error.contains("volume") && error.contains(".npy or .tif"), "{error}");
        assert!(check_dimension(at(name), format, 3).is_err());
        assert!(check_dimension(at(name), format, 2).is_ok());
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn masks_come_back_in_every_format() {
    let folder = tempdir().unwrap();
    let picture = Grid::from_fn(Shape::new([7, 5]).unwrap(), |[x, y]| x > 2 * y);
    for ending in ["png", "npy", "tif"] {
        let path = folder.path().join(format!("mask.{ending}"));
        write_mask(&path, None, false, &picture, None).unwrap();
        assert_eq!(read_mask(&path, [1.0; 2]).unwrap().open(), &picture, "{ending}");
        assert!(write_mask(&path, None, false, &picture, None).is_err(), "it exists");
    }
    let pixels = image::open(folder.path().join("mask.png")).unwrap().into_luma8();
    assert_eq!((pixels.get_pixel(1, 0).0, pixels.get_pixel(0, 0).0), ([255], [0]));
    let volume = Grid::from_fn(Shape::new([4, 3, 2]).unwrap(), |[x, _, z]| x > z);
    let path = folder.path().join("volume.tif");
    write_mask(&path, None, false, &volume, None).unwrap();
    assert_eq!(read_mask(&path, [1.0; 3]).unwrap().open(), &volume);
    let png = folder.path().join("volume.png");
    assert!(matches!(write_mask(png, None, false, &volume, None), Err(WriteError::Volume { .. })));
}

/// What a killed process leaves goes, of this output alone; names may be as long as they can be.
#[test]
fn leftovers_of_killed_processes_go() {
    let folder = tempdir().unwrap();
    let long = format!("{}.json", "\u{e9}".repeat(120));
    for name in ["a.json", &long] {
        let file = folder.path().join(name);
        write_atomically(&file, false, |out| {
            // What is killed now leaves this.
            let is_new = |path: &Path| {
                let name = path.to_string_lossy();
                name.ends_with(".part") && !name.ends_with("-killed.part")
            };
            let parts = fs::read_dir(folder.path())?.flatten().map(|entry| entry.path());
            for part in parts.filter(|path| is_new(path)) {
                fs::copy(&part, part.to_string_lossy().replace(".part", "-killed.part"))?;
            }
            out.write_all(b"{}")
        })
        .unwrap();
    }
    let count = || fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(count(), 4);
    remove_leftovers(folder.path().join("a.json")).unwrap();
    assert_eq!(count(), 3);
    remove_leftovers(folder.path().join("b.json")).unwrap();
    assert_eq!(count(), 3);
    remove_leftovers(folder.path().join(&long)).unwrap();
    assert_eq!(count(), 2);
    remove_leftovers(folder.path().join("missing/a.json")).unwrap();
}
