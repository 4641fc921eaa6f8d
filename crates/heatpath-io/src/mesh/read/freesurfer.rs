//! `FreeSurfer` surfaces.

use super::cursor::{Cursor, Kind, Order};
use super::{Found, Reading, Soup, vertex};

/// A line of comment and an empty one, the counts, the points, the triangles; all big-endian.
pub(super) fn read(bytes: &[u8]) -> Reading {
    let mut cursor = Cursor::new(bytes);
    cursor.take(3)?;
    while cursor.take(1)? != b"\n" {}
    if cursor.rest().first() == Some(&b'\n') {
        cursor.take(1)?;
    }
    let points = cursor.binary(Kind::U32, Order::Big)? as u32;
    let faces = cursor.binary(Kind::U32, Order::Big)? as u32;
    let mut soup = Soup::default();
    for _ in 0..points {
        soup.push_point(three(&mut cursor, Kind::F32)?);
    }
    for _ in 0..faces {
        let [a, b, c] = three(&mut cursor, Kind::I32)?;
        soup.push([vertex(a)?, vertex(b)?, vertex(c)?]);
    }
    Ok(Found::new(soup))
}

fn three(cursor: &mut Cursor<'_>, kind: Kind) -> Result<[f64; 3], String> {
    let mut next = || cursor.binary(kind, Order::Big);
    Ok([next()?, next()?, next()?])
}
