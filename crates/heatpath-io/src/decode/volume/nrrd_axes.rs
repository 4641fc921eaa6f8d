//! Which axes of an NRRD lie in space.

use super::nrrd::Fields;
use crate::placement::Vector;

/// The kinds of axes along which a grid lies in space; all others hold several values of a cell.
const SPATIAL: [&str; 4] = ["domain", "space", "none", "???"];

/// The kinds of axes that hold a colour.
const COLOURS: [&str; 4] = ["rgb-color", "rgba-color", "3-color", "4-color"];

/// Which axes lie in space.
pub(super) struct Axes {
    /// The first one.
    pub(super) first: usize,
    /// Two or three.
    pub(super) count: usize,
    /// From cell to cell along each axis of the file; none for those that hold values of a cell.
    pub(super) directions: Option<Vec<Option<Vector>>>,
    pub(super) is_colour: bool,
}

impl Axes {
    pub(super) fn new(fields: &Fields<'_>, sizes: &[u64]) -> Result<Self, String> {
        let axes = sizes.len();
        let all = |name: &str, found: usize| {
            let message = format!("{name} names {found} axes, but sizes has {axes}");
            if found == axes { Ok(()) } else { Err(message) }
        };
        let directions = fields.get("spacedirections").map(vectors).transpose()?;
        let kinds: Option<Vec<String>> =
            fields.get("kinds").map(|kinds| words(&kinds.to_ascii_lowercase()));
        if let Some(directions) = &directions {
            all("space directions", directions.len())?;
        }
        if let Some(kinds) = &kinds {
            all("kinds", kinds.len())?;
        }
        let is_spatial = |axis: &usize| match (&directions, &kinds) {
            (Some(directions), _) => directions[*axis].is_some(),
            (None, Some(kinds)) => SPATIAL.contains(&kinds[*axis].as_str()),
            (None, None) => true,
        };
        let first = (0..axes).find(is_spatial).unwrap_or(0);
        // A fourth axis without a direction of its own is one of frames.
        let count = (first..axes).take(3).take_while(is_spatial).count();
        if count < 2 || (first + count..axes).any(|axis| count < 3 && is_spatial(&axis)) {
            return Err(format!(
                "{axes} axes, of which {count} lie in space side by side; 2 or 3 are needed"
            ));
        }
        let is_colour = kinds.is_some_and(|kinds| COLOURS.contains(&kinds[0].as_str()));
        Ok(Self { first, count, directions, is_colour })
    }
}

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

/// Vectors as `(1,0,0) (0,1,0) none`.
pub(super) fn vectors(text: &str) -> Result<Vec<Option<Vector>>, String> {
    let mut found = Vec::new();
    let mut rest = text.trim();
    while !rest.is_empty() {
        if let Some(after) = rest.strip_prefix("none") {
            found.push(None);
            rest = after.trim_start();
            continue;
        }
        let inside = rest.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        let (inside, after) = inside.ok_or_else(|| format!("{rest:?} is no vector"))?;
        let parts = inside.split(',').map(|part| part.trim().parse::<f64>());
        let parts = parts.collect::<Result<Vec<_>, _>>().unwrap_or_default();
        let vector: Vector = match parts[..] {
            [x, y] => [x, y, 0.0],
            [x, y, z] => [x, y, z],
            _ => return Err(format!("({inside}) is no vector of two or three numbers")),
        };
        found.push(Some(vector).filter(|vector| !vector.iter().any(|x| x.is_nan())));
        rest = after.trim_start();
    }
    Ok(found)
}
