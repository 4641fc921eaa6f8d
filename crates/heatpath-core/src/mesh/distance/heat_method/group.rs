//! Sources of one label, which are solved for together.

use super::near::Near;
use crate::linear::{Pin, Wide};
use crate::mesh::{Source, Sources, TriMesh};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::f64::consts::LN_2;

/// The sources of one label in one set.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The number of the set.
    pub(super) set: usize,
    pub(super) label: u32,
    pub(super) sources: Vec<Source>,
}

impl Group {
    /// The groups of several sets of sources.
    pub(super) fn all(sets: &[Sources]) -> Vec<Self> {
        let mut groups: BTreeMap<(usize, u32), Vec<Source>> = BTreeMap::new();
        for (set, sources) in sets.iter().enumerate() {
            for &source in sources.list() {
                groups.entry((set, source.label)).or_default().push(source);
            }
        }
        let group = |((set, label), sources)| Self { set, label, sources };
        groups.into_iter().map(group).collect()
    }

    pub(super) fn least_offset(&self) -> f64 {
        self.sources.iter().map(|source| source.offset).fold(f64::INFINITY, f64::min)
    }

    /// The heat that the sources begin with, less where an offset is larger: vertices and amounts.
    /// Heat falls by e over the distance `reach`.
    pub(super) fn charges(&self, mesh: &TriMesh, reach: f64) -> Vec<(u32, Wide)> {
        let charge = |source: &Source| {
            let amount = exp(-(source.offset - self.least_offset()) / reach);
            mesh.shares(&source.point).into_iter().map(move |(v, weight)| (v, amount.times(weight)))
        };
        self.sources.iter().flat_map(charge).collect()
    }

    /// The places of the sources with their distances.
    pub(super) fn pins(&self, mesh: &TriMesh, near: &Near, components: &[usize]) -> Vec<Pin> {
        let pin = |source: &Source| {
            let shares = mesh.shares(&source.point);
            Pin {
                component: components[shares[0].0 as usize],
                value: shares.iter().map(|(vertex, weight)| weight * near.distances[vertex]).sum(),
                parts: shares
                    .into_iter()
                    .map(|(vertex, weight)| (vertex as usize, weight))
                    .collect(),
            }
        };
        let mut pins: Vec<Pin> = self.sources.iter().map(pin).collect();
        pins.sort_by(|a, b| a.parts.partial_cmp(&b.parts).unwrap_or(Ordering::Equal));
        pins.dedup_by(|a, b| a.parts == b.parts);
        pins
    }
}

/// `e^exponent`, however small.
fn exp(exponent: f64) -> Wide {
    let powers = (exponent / LN_2).floor().max(-1e9);
    Wide::new((exponent - powers * LN_2).exp(), powers as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_e() {
        assert!((exp(-3.0).to_f64() - (-3.0_f64).exp()).abs() < 1e-17);
        assert!((exp(-1e5).ln() + 1e5).abs() < 1e-9);
        assert_eq!(exp(0.0).to_f64(), 1.0);
    }
}
