//! How meshes are kept in files.

use serde::Serialize;
use std::fmt;
use std::path::Path;

/// A format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum MeshFormat {
    /// Polygon file format (Stanford).
    Ply,
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography.
    Stl,
    /// Object file format (Geomview).
    Off,
    /// Poly data of VTK, legacy.
    Vtk,
    /// Poly data of VTK, XML.
    Vtp,
    /// glTF 2, binary (GLB) or JSON.
    Gltf,
    /// A surface of `FreeSurfer`.
    FreeSurfer,
}

impl MeshFormat {
    /// The format of a file by its content, or else, for the formats that do not say what they are,
    /// by the ending of its name.
    #[must_use]
    pub fn recognise(bytes: &[u8], path: &Path) -> Option<Self> {
        Self::from_magic(bytes).or_else(|| Self::from_text(bytes)).or_else(|| {
            let ending = path.extension()?.to_str()?.to_ascii_lowercase();
            Some(match ending.as_str() {
                "obj" => Self::Obj,
                "off" => Self::Off,
                "stl" => Self::Stl,
                _ => return None,
            })
        })
    }

    fn from_magic(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [b'p', b'l', b'y', b'\r' | b'\n', ..] => Some(Self::Ply),
            [b'g', b'l', b'T', b'F', ..] => Some(Self::Gltf),
            [0xff, 0xff, 0xfe, ..] => Some(Self::FreeSurfer),
            _ if bytes.starts_with(b"# vtk DataFile") => Some(Self::Vtk),
            _ if is_binary_stl(bytes) => Some(Self::Stl),
            _ => None,
        }
    }

    /// By the first word that is no comment.
    fn from_text(bytes: &[u8]) -> Option<Self> {
        let start = &bytes[..bytes.len().min(4096)];
        let mut lines = start.split(|c| matches!(c, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
        let line = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
        let word = line.split(u8::is_ascii_whitespace).next()?;
        match word {
            [b'<', ..] if contains(start, b"PolyData") => Some(Self::Vtp),
            [b'{', ..] if contains(bytes, b"\"asset\"") => Some(Self::Gltf),
            b"v" | b"vt" | b"vn" | b"o" | b"g" | b"mtllib" | b"usemtl" => Some(Self::Obj),
            _ if word.eq_ignore_ascii_case(b"solid") => Some(Self::Stl),
            _ if word.len() < 9 && word.ends_with(b"OFF") => Some(Self::Off),
            _ => None,
        }
    }

    /// Whether files of this format write vertices more than once, so that they must be welded.
    #[must_use]
    pub fn is_torn(self) -> bool {
        matches!(self, Self::Stl | Self::Gltf)
    }
}

/// Whether the length is that of the number of triangles which the header names. Some such files
/// begin with `solid`, like text.
pub(super) fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count))
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

impl fmt::Display for MeshFormat {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(match self {
            Self::Ply => "PLY",
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Off => "OFF",
            Self::Vtk => "VTK poly data",
            Self::Vtp => "VTP",
            Self::Gltf => "glTF",
            Self::FreeSurfer => "FreeSurfer surface",
        })
    }
}
