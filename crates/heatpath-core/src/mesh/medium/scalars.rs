//! Equation (6) on a surface: heat flows where a texture resembles the source's.

use super::given::check_count;
use super::{Medium, MediumError};
use crate::error::{check, check_positive};
use crate::mesh::TriMesh;
use std::sync::Arc;

/// The parameters of [`Medium::scalars`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalarsOptions {
    /// The power n of eq. (6): how strongly unlike values are held back. Positive; default 3.
    pub power: f64,
    /// The constant epsilon of eq. (6), which keeps the speed positive. Positive; default 1e-3.
    pub floor: f64,
}

impl Default for ScalarsOptions {
    fn default() -> Self {
        Self { power: 3.0, floor: 1e-3 }
    }
}

impl Medium {
    /// The squared speed `P = |1 - |f(p0) - f(x)||^n + epsilon` (eq. 6 as the P of eq. 16) of a texture
    /// or measurement f with one value a vertex.
    ///
    /// `values` are f, scaled to `[0, 1]`. `references` are the values f(p0) to resemble, usually
    /// those at the sources; of several, the nearest in value counts at each vertex. Lengths are
    /// `ds / sqrt(P)`.
    ///
    /// # Errors
    /// There is not one value a vertex, a value or reference is not finite, there is no reference,
    /// or a parameter is out of range.
    pub fn scalars(
        mesh: impl Into<Arc<TriMesh>>,
        values: &[f64],
        references: &[f64],
        options: ScalarsOptions,
    ) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        check_count("vertices", values.len(), mesh.points().len())?;
        check_positive("power", options.power)?;
        check_positive("floor", options.floor)?;
        for &value in values {
            check("scalar value", value, value.is_finite(), "finite")?;
        }
        for &reference in references {
            check("reference value", reference, reference.is_finite(), "finite")?;
        }
        check("number of reference values", 0.0, !references.is_empty(), "at least 1")?;
        let speed_sq: Vec<f64> = values.iter().map(|&f| alike(f, references, options)).collect();
        Self::given(mesh, &speed_sq)
    }
}

fn alike(value: f64, references: &[f64], options: ScalarsOptions) -> f64 {
    let difference = references.iter().map(|r| (r - value).abs()).fold(f64::INFINITY, f64::min);
    (1.0 - difference).abs().powf(options.power) + options.floor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::sheet;

    fn two_squares() -> TriMesh {
        sheet(2, 1, |column, row| [column as f64, row as f64, 0.0])
    }

    #[test]
    fn equation_6_in_numbers() {
        let options = ScalarsOptions { power: 2.0, floor: 0.01 };
        let values = [0.2, 0.7, 1.0, 0.2, 0.7, 1.0];
        let of = |references: &[f64]| {
            Medium::scalars(two_squares(), &values, references, options)
                .unwrap()
                .speed_sq()
                .to_vec()
        };
        for (found, expected) in of(&[0.2]).iter().zip([1.01, 0.26, 0.05, 1.01, 0.26, 0.05]) {
            assert!((found - expected).abs() < 1e-15);
        }
        assert!((of(&[0.2, 0.9])[2] - 0.82).abs() < 1e-15, "the nearest reference counts");
    }

    #[test]
    fn bad_values_are_named() {
        let text = |values: &[f64], references: &[f64], power| {
            let options = ScalarsOptions { power, ..Default::default() };
            Medium::scalars(two_squares(), values, references, options).unwrap_err().to_string()
        };
        assert_eq!(text(&[0.5; 5], &[0.5], 3.0), "5 values were given for 6 vertices");
        assert_eq!(text(&[f64::NAN; 6], &[0.5], 3.0), "scalar value is NaN; it must be finite");
        let none = "number of reference values is 0; it must be at least 1";
        assert_eq!(text(&[0.5; 6], &[], 3.0), none);
        let negative = "power is -1; it must be a positive finite number";
        assert_eq!(text(&[0.5; 6], &[0.5], -1.0), negative);
    }
}
