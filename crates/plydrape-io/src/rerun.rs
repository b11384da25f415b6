//! A run that was interrupted, where an earlier one has left its results: what is there stays, unless what comes is better.

use crate::result::read;
use crate::store::format::FILE;
use crate::{Error, Folder, ResultFile};
use std::cmp::Ordering;
use std::path::Path;

/// The folder beside the claimed one into which an interrupted run writes, because what is there is no worse; `None` if it may write into the
/// claimed one. `is_better` compares it with what is in a folder.
///
/// # Errors
/// As [`Folder::claim`].
pub fn beside(folder: &Folder, is_better: impl Fn(&Path) -> bool) -> Result<Option<Folder>, Error> {
    if is_better(folder.path()) {
        return Ok(None);
    }
    let (mut ending, mut number) = (".interrupted".to_owned(), 1);
    loop {
        match folder.claim_beside(&ending) {
            Ok(other) if is_better(other.path()) => return Ok(Some(other)),
            // another interrupted run that is no worse, or that writes
            Ok(_) | Err(Error::Busy { .. }) => {}
            Err(fault) => return Err(fault),
        }
        number += 1;
        ending = format!(".interrupted-{number}");
    }
}

/// Whether a result is better than that in a folder, which may have none. Results of different scenes cannot be compared, and one that cannot be
/// read is not known to be worse.
#[must_use]
pub fn is_better(result: &ResultFile, dir: &Path) -> bool {
    if !dir.join(FILE).exists() {
        return true;
    }
    let Ok(earlier) = read::read(dir) else { return false };
    let unproven = result.summary.sample.is_none() && earlier.summary.sample.is_some();
    earlier.scene.input == result.scene.input && !unproven && order(result, &earlier).is_lt()
}

/// The better result first: an accepted one, then a finished one, then that whose worst measure is farther from its limit.
fn order(a: &ResultFile, b: &ResultFile) -> Ordering {
    let rank = |result: &ResultFile| {
        let summary = &result.summary;
        (!summary.accepted(), summary.interrupted())
    };
    let worst = |result: &ResultFile| {
        result.summary.limits.iter().map(|verdict| verdict.ratio()).fold(0.0, f64::max)
    };
    rank(a).cmp(&rank(b)).then_with(|| worst(a).total_cmp(&worst(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{sample, write_all};

    /// A slack ratio of 2 % and one of 1 %, against a limit.
    fn result(value: f64, ok: bool) -> ResultFile {
        let mut result = sample::draped(2, 2, 3);
        let verdict = &mut result.summary.limits[0];
        (verdict.value, verdict.ok) = (value * verdict.limit, ok);
        result.summary.limits.truncate(1);
        result
    }

    /// What is accepted stays where the other one is not; of two that are not, the one nearer to its limit; of equal ones the earlier.
    #[test]
    fn only_a_better_result_takes_the_place_of_an_earlier_one() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        assert!(is_better(&result(3.0, false), &dir));
        write_all(&result(2.0, false), &dir).unwrap();
        assert!(!is_better(&result(3.0, false), &dir));
        assert!(!is_better(&result(2.0, false), &dir));
        assert!(is_better(&result(1.5, false), &dir));
        assert!(is_better(&result(0.9, true), &dir));
        write_all(&result(0.9, true), &dir).unwrap();
        assert!(!is_better(&result(0.95, true), &dir));
        assert!(!is_better(&result(1.1, false), &dir));
        let mut other = result(0.5, true);
        other.scene.input = Some("another = 1".into());
        assert!(!is_better(&other, &dir), "of another scene");
    }

    /// Beside the folder, and beside what is there already; an unknown file is not known to be worse.
    #[test]
    fn an_interrupted_run_finds_a_folder_of_its_own() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        let place = |new: &ResultFile| {
            let folder = Folder::claim(&dir, "plan", &[]).unwrap();
            beside(&folder, |dir| is_better(new, dir)).unwrap()
        };
        assert!(place(&result(3.0, false)).is_none());
        write_all(&result(0.9, true), &dir).unwrap();
        let other = place(&result(2.0, false)).unwrap();
        assert_eq!(other.path(), home.path().join("out.interrupted"));
        crate::write_into(other, &result(2.0, false), &[]).unwrap();
        let better = place(&result(1.5, false)).unwrap();
        assert_eq!(better.path(), home.path().join("out.interrupted"));
        drop(better);
        let worse = place(&result(3.0, false)).unwrap();
        assert_eq!(worse.path(), home.path().join("out.interrupted-2"));
        assert!(read::read(&dir).unwrap().summary.accepted());
    }
}
