//! How long drapes take, against sums by hand. No time is measured.

use super::forecast::{CONSTANTS, Effort, Forecast, Pace, solves};
use std::time::Duration;

fn effort(nodes: usize, solves: usize, seconds: u64) -> Effort {
    Effort { nodes, solves, time: Duration::from_secs(seconds) }
}

fn forecast(seconds: u64, cells: usize, threads: usize) -> Forecast {
    let (drape, cell) = (Duration::from_secs(seconds), CONSTANTS.cell);
    Forecast { nodes: 961, drape, cells, cell, threads }
}

/// w(n₀) = 2 n₀ and w(32 n₀) = 32 n₀ (1 + 32^0.8) = 32 n₀ · 17, so one system of the latter is 272 times one of the former.
#[test]
fn a_drape_takes_longer_with_its_systems_and_their_nodes() {
    let few = CONSTANTS.even_nodes as usize;
    let mut pace = Pace::default();
    pace.add(effort(few, 100, 7));
    let time = |nodes, solves| Forecast::new(nodes, solves, pace).drape.as_secs_f64();
    assert!((time(few, 100.0) - 7.0).abs() < 1e-6);
    assert!((time(few, 250.0) - 17.5).abs() < 1e-6);
    assert!((time(32 * few, 100.0) / 7.0 - 272.0).abs() < 1e-6);
}

/// A drape of 100 systems in 1 s and one of 300 in 7 s, with the same nodes: 8 s for 400, not the mean of both paces.
#[test]
fn the_pace_is_that_of_all_drapes_together() {
    let mut pace = Pace::default();
    assert_eq!(pace.seconds(), CONSTANTS.seconds);
    pace.add(effort(500, 100, 1));
    pace.add(effort(500, 300, 7));
    let drape = Forecast::new(500, 100.0, pace).drape.as_secs_f64();
    assert!((drape - 2.0).abs() < 1e-6, "{drape}");
}

#[test]
fn a_finer_mesh_needs_a_few_more_systems() {
    let ranked = effort(250, 400, 1);
    assert!((solves(250, ranked) - 400.0).abs() < 1e-9);
    // 1024 = 4^5: a fifth of the power is 4
    let growth = CONSTANTS.growth / 0.2;
    assert!((solves(1024 * 250, ranked) - 400.0 * 4.0_f64.powf(growth)).abs() < 1e-6);
}

/// The second drape is at once with the first on two threads and after it on one; cells follow, one a thread at once.
#[test]
fn a_decision_is_its_drapes_and_then_its_cells() {
    let (between, cell) = (CONSTANTS.between, CONSTANTS.cell);
    let takes = |cells, threads| forecast(10, cells, threads).decision().as_secs_f64();
    for (cells, threads, drapes) in [
        (0, 1, 1.0 + between),
        (0, 2, between),
        (3, 1, 1.0 + between + 3.0 * cell),
        (3, 2, between + 2.0 * cell),
        (3, 8, between + cell),
    ] {
        let found = takes(cells, threads);
        assert!((found - 10.0 * drapes).abs() < 1e-6, "{cells} {threads}: {found}");
    }
}

#[test]
fn a_sample_takes_as_long_as_its_cells_on_one_thread() {
    assert_eq!(forecast(10, 3, 2).sample(0), Duration::ZERO);
    for (cells, threads, in_turn) in [(64, 2, 32.0), (63, 2, 32.0), (64, 1, 64.0), (64, 100, 1.0)] {
        let found = forecast(10, 0, threads).sample(cells).as_secs_f64();
        assert!((found - 10.0 * CONSTANTS.cell * in_turn).abs() < 1e-6, "{cells} {threads}");
    }
    assert_eq!(Forecast::like(effort(961, 400, 10)).drape, Duration::from_secs(10));
    // a ply without a mold has no flight that its cells could share
    let whole = Forecast::like(effort(961, 400, 10)).along(&crate::errors::tests::layup(2, 2));
    assert_eq!(whole.cell, CONSTANTS.whole_cell);
}

/// A time that no duration holds is a very long one.
#[test]
fn no_forecast_panics() {
    let mut pace = Pace::default();
    pace.add(effort(1, 1, u64::MAX));
    let forecast = Forecast::new(usize::MAX, 1e9, pace);
    assert!(forecast.decision() > Duration::from_secs(1_000_000));
    assert!(forecast.sample(64) > forecast.drape);
}
