//! Options that would do nothing.

use crate::failure::Failure;
use clap::ValueEnum;

/// An option: whether it is given, its name, and the values of another option that it needs.
pub(super) type Need<'a, T> = (bool, &'static str, &'a [T]);

/// Refuses options that are given although `chosen`, the value of the option `by`, has no use for them.
pub(super) fn refuse_idle<T: ValueEnum + PartialEq>(
    by: &str,
    chosen: &T,
    needs: &[Need<'_, T>],
) -> Result<(), Failure> {
    let is_idle = |need: &&Need<'_, T>| need.0 && !need.2.contains(chosen);
    let Some((_, option, values)) = needs.iter().find(is_idle) else { return Ok(()) };
    let values = values.iter().filter_map(ValueEnum::to_possible_value);
    let values: Vec<String> = values.map(|value| format!("`{by} {}`", value.get_name())).collect();
    let values = values.join(" or ");
    Err(Failure::usage(format!("{option} does nothing here: it needs {values}")))
}
