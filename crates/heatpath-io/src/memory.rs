//! Nothing is read that memory cannot hold.

use crate::ReadError;
use std::fs;
use std::path::Path;

/// Less than this is not looked at.
const SMALL: u64 = 64 << 20;

/// Refuses what needs more bytes than are free.
pub(crate) fn check(path: &Path, needed: u64) -> Result<(), ReadError> {
    if needed <= SMALL {
        return Ok(());
    }
    match available() {
        Some(available) if needed > available => {
            Err(ReadError::Memory { path: path.to_owned(), needed, available })
        }
        _ => Ok(()),
    }
}

/// The free bytes of memory, within the limit of a container; none where the system does not say.
fn available() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let free = kilobytes(&text, "MemAvailable:")?.saturating_mul(1024);
    let limit = fs::read_to_string("/sys/fs/cgroup/memory.max").ok();
    let limit = limit.and_then(|text| text.trim().parse().ok());
    Some(free.min(limit.unwrap_or(u64::MAX)))
}

fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_memory_cannot_hold_is_refused_with_the_numbers() {
        assert!(check(Path::new("a.nrrd"), 1 << 20).is_ok());
        if let Err(error) = check(Path::new("a.nrrd"), 1 << 60) {
            let text = error.to_string();
            assert!(text.starts_with("a.nrrd: ") && text.contains("1073741824.0 GiB"), "{text}");
        }
    }

    #[test]
    fn the_line_of_the_system_is_found() {
        let text = "MemTotal:  10 kB\nMemAvailable:   1234 kB\n";
        assert_eq!(kilobytes(text, "MemAvailable:"), Some(1234));
        assert_eq!(kilobytes(text, "MemFree:"), None);
        assert_eq!(kilobytes("MemAvailable: x kB", "MemAvailable:"), None);
    }
}
