//! How long drapes will take, in words.

use plydrape::outcome::Forecast;
use std::time::Duration;

/// What a decision takes, or how long it still does where that is known, and a sample of this many cells that may follow it.
#[must_use]
pub fn decision(forecast: &Forecast, left: Option<Duration>, cells: usize) -> String {
    let (nodes, decision) = (forecast.nodes, takes(forecast.decision(), left));
    match cells {
        0 => format!("{nodes} nodes, {decision}"),
        cells => {
            let sample = sample(forecast, None, cells);
            format!("{nodes} nodes, {decision}, then at most {cells} cells with errors, {sample}")
        }
    }
}

/// What a sample of cells takes, or how long it still does where that is known.
#[must_use]
pub fn sample(forecast: &Forecast, left: Option<Duration>, cells: usize) -> String {
    takes(forecast.sample(cells), left)
}

fn takes(whole: Duration, left: Option<Duration>) -> String {
    left.map_or_else(|| about(whole), |left| format!("{} left", about(left)))
}

/// A time in words, with no more digits than it has where it is known within a factor of 1.5.
#[must_use]
pub fn about(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let whole = |value: f64, unit: f64| (value / unit).round() * unit;
    match seconds {
        ..1.0 => "less than 1 s".into(),
        ..20.0 => format!("about {} s", whole(seconds, 1.0)),
        ..150.0 => format!("about {} s", whole(seconds, 5.0)),
        ..9000.0 => format!("about {} min", whole(seconds / 60.0, 1.0)),
        _ => format!("about {} h", whole(seconds / 3600.0, 1.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drape of 3 s, two drapes at once: a sample of 64 is 32 times one of 3.75 s.
    #[test]
    fn a_forecast_says_nodes_cells_and_times_in_few_digits() {
        let drape = Duration::from_secs(3);
        let forecast = Forecast { nodes: 961, drape, cells: 0, cell: 1.25, threads: 2 };
        assert_eq!(decision(&forecast, None, 0), "961 nodes, about 4 s");
        let left = Some(Duration::from_secs(2));
        assert_eq!(decision(&forecast, left, 0), "961 nodes, about 2 s left");
        let shown = decision(&forecast, None, 64);
        assert_eq!(shown, "961 nodes, about 4 s, then at most 64 cells with errors, about 120 s");
        assert_eq!(sample(&forecast, None, 1), "about 4 s");
        assert_eq!(sample(&forecast, left, 64), "about 2 s left");
    }

    #[test]
    fn times_are_rounded_to_what_is_known() {
        let shown = [0.2, 1.4, 19.4, 43.0, 148.0, 150.0, 5000.0, 9000.0, 1e5];
        let shown = shown.map(|seconds| about(Duration::from_secs_f64(seconds)));
        let expected = [
            "less than 1 s",
            "about 1 s",
            "about 19 s",
            "about 45 s",
            "about 150 s",
            "about 3 min",
            "about 83 min",
            "about 3 h",
            "about 28 h",
        ];
        assert_eq!(shown, expected);
    }
}
