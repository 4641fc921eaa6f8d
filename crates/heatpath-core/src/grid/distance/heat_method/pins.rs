//! Right-hand sides of the Poisson equation with cells whose values are given.

use crate::linear::{Entries, Wide};
use std::collections::BTreeMap;

/// A cell, the component it lies in, and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pin {
    pub(super) cell: usize,
    pub(super) component: usize,
    pub(super) value: f64,
}

/// A right-hand side with pins, on the way to its solution.
///
/// A pin puts a charge into its cell, as large as it takes. The charges are found by conjugate
/// gradients, each step of which is one solution of the prepared system. They add up to zero in each
/// component; so a pin alone in its component has none, and only says which constant is the right
/// one.
#[derive(Debug)]
pub(super) struct Pinned {
    pins: Vec<Pin>,
    /// The charge of each pin that the next solution is for, and what is right of it already.
    search: Vec<f64>,
    residual: Vec<f64>,
    values: Vec<f64>,
    steps: usize,
}

/// Pins are met to this part of the largest value.
const TOLERANCE: f64 = 1e-10;

impl Pinned {
    /// The pins and the solution without charges.
    pub(super) fn new(pins: Vec<Pin>, values: Vec<f64>) -> Self {
        let mut system = Self { pins, search: vec![], residual: vec![], values, steps: 0 };
        system.residual = system.without_means(system.missing());
        system.search = system.residual.clone();
        system
    }

    /// Whether no step is needed any more. Twice as many as there are pins do not help.
    pub(super) fn is_finished(&self) -> bool {
        largest(&self.residual) <= TOLERANCE * largest(&self.values)
            || self.steps > 2 * self.pins.len()
    }

    /// The right-hand side of the next step.
    pub(super) fn side(&self, places: &[usize]) -> Entries {
        let charges = self.pins.iter().zip(&self.search);
        charges.map(|(pin, &charge)| (places[pin.cell], Wide::from(charge))).collect()
    }

    /// Makes a step with the solution for [`side`](Self::side).
    pub(super) fn step(&mut self, solution: &[f64]) {
        let at_pins: Vec<f64> = self.pins.iter().map(|pin| solution[pin.cell]).collect();
        let square = dot(&self.residual, &self.residual);
        let length = square / dot(&self.search, &at_pins);
        add(&mut self.values, length, solution);
        let change = self.without_means(at_pins);
        add(&mut self.residual, -length, &change);
        let again = dot(&self.residual, &self.residual) / square;
        let last = std::mem::replace(&mut self.search, self.residual.clone());
        add(&mut self.search, again, &last);
        self.steps += 1;
    }

    /// The solution with the constant in each component with which the pins have their values;
    /// infinite in components without pins.
    pub(super) fn finish(mut self, components: &[usize]) -> Vec<f64> {
        let constants = self.means(&self.missing());
        for (value, component) in self.values.iter_mut().zip(components) {
            *value += constants.get(component).copied().unwrap_or(f64::INFINITY);
        }
        self.pins.iter().for_each(|pin| self.values[pin.cell] = pin.value);
        self.values
    }

    /// What the values of the pins lack.
    fn missing(&self) -> Vec<f64> {
        self.pins.iter().map(|pin| pin.value - self.values[pin.cell]).collect()
    }

    /// `values` of the pins, each less the mean of its component.
    fn without_means(&self, values: Vec<f64>) -> Vec<f64> {
        let means = self.means(&values);
        values.into_iter().zip(&self.pins).map(|(x, pin)| x - means[&pin.component]).collect()
    }

    /// The mean of `values` of the pins in each component.
    fn means(&self, values: &[f64]) -> BTreeMap<usize, f64> {
        let mut sums = BTreeMap::new();
        for (pin, value) in self.pins.iter().zip(values) {
            let (sum, count) = sums.entry(pin.component).or_insert((0.0, 0.0));
            (*sum, *count) = (*sum + value, *count + 1.0);
        }
        sums.into_iter().map(|(component, (sum, count))| (component, sum / count)).collect()
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(to: &mut [f64], factor: f64, what: &[f64]) {
    to.iter_mut().zip(what).for_each(|(to, x)| *to += factor * x);
}
