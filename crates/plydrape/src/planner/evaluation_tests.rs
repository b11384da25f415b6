//! A plan is made with other cells than those that judge it.

use super::evaluation::{planned_errors, with_errors};
use super::tuning::TUNING;
use crate::errors::tests::{budget, layup};
use crate::errors::{Draw, Errors};
use crate::layup::Layup;
use crate::motion::Motion;
use crate::outcome::Judged;
use proptest::prelude::*;
use std::sync::Mutex;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Whatever the seed of the sample, none of its cells is one of the few that the search looks at, nor is an error of one the same.
    #[test]
    fn no_cell_of_the_search_is_one_of_the_sample(seed in any::<u64>()) {
        let errors = Errors { seed, ..budget() };
        let draws = |errors: Errors, count: usize| -> Vec<Draw> {
            (0..count).map(|n| errors.draw(n, 4)).collect()
        };
        let planned = draws(planned_errors(errors), TUNING.cells);
        for cell in draws(errors, errors.samples) {
            for own in &planned {
                prop_assert_ne!(own.frame, cell.frame);
                prop_assert_ne!(&own.grippers, &cell.grippers);
                prop_assert_ne!(own.material, cell.material);
            }
        }
    }
}

/// The cells that are draped for a candidate are those of the search, and none of the sample that judges the plan.
#[test]
fn a_candidate_is_ranked_by_the_cells_of_the_search() {
    let (layup, errors) = (layup(2, 2), budget());
    let judged = || Judged {
        limits: Vec::new(),
        complete: true,
        missing: 0.0,
        unsolved: 0,
        interrupted: false,
        effort: None,
    };
    let seen: Mutex<Vec<Motion>> = Mutex::new(Vec::new());
    with_errors(&layup, Some(errors), judged(), |cell: Layup| {
        seen.lock().unwrap().push(cell.motion);
        Some(judged())
    });
    let seen = seen.into_inner().unwrap();
    let motions = |errors: Errors, count: usize| -> Vec<Motion> {
        (0..count).map(|n| errors.draw(n, 4).apply(&layup).motion).collect()
    };
    let planned = motions(planned_errors(errors), TUNING.cells);
    assert_eq!(seen.len(), planned.len());
    assert!(planned.iter().all(|motion| seen.contains(motion)));
    let sample = motions(errors, errors.samples);
    assert!(sample.iter().all(|motion| !seen.contains(motion)));
}
