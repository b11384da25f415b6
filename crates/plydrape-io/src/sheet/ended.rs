//! Why the end of a sheet's drape does not count, as a sentence.

use plydrape::sheet::Status;
use plydrape::sheet::measure::Summary;

/// Why the end of a drape with so many steps planned does not count; none where it does.
pub(crate) fn ended(summary: &Summary, planned: usize) -> Option<String> {
    let done = summary.steps;
    match summary.status {
        Status::Converged => None,
        Status::NotAtRest => Some("the sheet is not at rest at the end".into()),
        Status::NotSolved => {
            Some(format!("no state of the sheet was found after step {done} of {planned}"))
        }
        Status::Interrupted => Some(format!("interrupted after step {done} of {planned}")),
    }
}
