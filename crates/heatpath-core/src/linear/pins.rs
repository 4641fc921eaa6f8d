//! Right-hand sides of the Poisson equation with places whose values are given.

use std::collections::BTreeMap;

/// A place whose value is given.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pin {
    /// The unknowns of which the value is a weighted sum, with their weights, which add up to 1.
    pub(crate) parts: Vec<(usize, f64)>,
    /// The component that they lie in.
    pub(crate) component: usize,
    /// The value.
    pub(crate) value: f64,
}

impl Pin {
    /// The value here of a field.
    fn of(&self, field: &[f64]) -> f64 {
        self.parts.iter().map(|&(unknown, weight)| weight * field[unknown]).sum()
    }
}

/// A right-hand side with pins, on the way to its solution.
///
/// A pin puts a charge into its place, as large as it takes. The charges are found by conjugate
/// gradients, each step of which is one solution of the prepared system. They add up to zero in each
/// component; so a pin alone in its component has none, and only says which constant is the right
/// one.
#[derive(Debug)]
pub(crate) struct Pinned {
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
    pub(crate) fn new(pins: Vec<Pin>, values: Vec<f64>) -> Self {
        let mut system = Self { pins, search: vec![], residual: vec![], values, steps: 0 };
        system.residual = system.without_means(system.missing());
        system.search = system.residual.clone();
        system
    }

    /// Whether no step is needed any more. Twice as many as there are pins do not help.
    pub(crate) fn is_finished(&self) -> bool {
        largest(&self.residual) <= TOLERANCE * largest(&self.values)
            || self.steps > 2 * self.pins.len()
    }

    /// The right-hand side of the next step: unknowns and their charges.
    pub(crate) fn side(&self) -> Vec<(usize, f64)> {
        let charges = self.pins.iter().zip(&self.search);
        charges
            .flat_map(|(pin, charge)| pin.parts.iter().map(move |&(place, w)| (place, w * charge)))
            .collect()
    }

    /// Makes a step with the solution for [`side`](Self::side).
    pub(crate) fn step(&mut self, solution: &[f64]) {
        let at_pins: Vec<f64> = self.pins.iter().map(|pin| pin.of(solution)).collect();
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
    pub(crate) fn finish(mut self, components: &[usize]) -> Vec<f64> {
        let constants = self.means(&self.missing());
        for (value, component) in self.values.iter_mut().zip(components) {
            *value += constants.get(component).copied().unwrap_or(f64::INFINITY);
        }
        for pin in &self.pins {
            if let [(unknown, _)] = pin.parts[..] {
                self.values[unknown] = pin.value;
            }
        }
        self.values
    }

    /// What the values of the pins lack.
    fn missing(&self) -> Vec<f64> {
        self.pins.iter().map(|pin| pin.value - pin.of(&self.values)).collect()
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
