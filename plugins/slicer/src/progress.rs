//! The protocol by which a host learns how far a module is.

use crate::print;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

/// The thousandths that were told last, never falling.
static TOLD: AtomicU32 = AtomicU32::new(0);

/// Tells that the module begins, and from now on how far it is; the function that is returned tells
/// that it has ended.
pub(crate) fn begin(name: &'static str) -> impl FnOnce() {
    let start = Instant::now();
    heatpath_cli::watch(tell);
    print(&format!(
        "<filter-start><filter-name>{name}</filter-name>\
         <filter-comment>\"heatpath {}\"</filter-comment></filter-start>\n",
        env!("CARGO_PKG_VERSION")
    ));
    move || {
        let seconds = start.elapsed().as_secs_f64();
        print(&format!(
            "<filter-end><filter-name>{name}</filter-name>\
             <filter-time>{seconds:.3}</filter-time></filter-end>\n"
        ));
    }
}

/// Tells the finished part whenever its thousandths grow; a second stage of the work, which begins at 0
/// again, is told from where it passes the first.
fn tell(finished: f64) {
    let thousandths = (finished * 1000.0) as u32;
    if TOLD.fetch_max(thousandths, Ordering::Relaxed) < thousandths {
        print(&format!("<filter-progress>{}</filter-progress>\n", f64::from(thousandths) / 1000.0));
    }
}
