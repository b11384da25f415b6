//! Times as ROS 2 says them: whole nanoseconds.

use super::message::{Duration, Time};
use crate::Error;

const NANO: u64 = 1_000_000_000;

/// The nanosecond nearest to a time (s) of a point.
///
/// # Errors
/// [`Error::NotPossible`] if it is before 0 or beyond what a message can say.
pub(super) fn nanoseconds(point: usize, time: f64) -> Result<u64, Error> {
    let whole = (time * NANO as f64).round();
    if !(0.0..i32::MAX as f64 * NANO as f64).contains(&whole) {
        let message =
            format!("point {point} is at {time} s, but ROS 2 takes times from 0 to 2147483647 s");
        return Err(Error::not_possible(message, "let the motion begin at 0"));
    }
    Ok(whole as u64)
}

/// A time (ns) as a duration of a message.
pub(super) fn duration(nanoseconds: u64) -> Duration {
    // checked above: below 2³¹ s
    Duration { sec: (nanoseconds / NANO) as i32, nanosec: (nanoseconds % NANO) as u32 }
}

/// A time (ns) as a stamp of a message.
pub(super) fn stamp(nanoseconds: u64) -> Time {
    let Duration { sec, nanosec } = duration(nanoseconds);
    Time { sec, nanosec }
}

/// Times (s) in whole nanoseconds, each after the one before.
///
/// # Errors
/// [`Error`] if one is not.
pub(super) fn clock(times: &[f64]) -> Result<Vec<u64>, Error> {
    let mut clock: Vec<u64> = Vec::with_capacity(times.len());
    for (k, time) in times.iter().enumerate() {
        let now = nanoseconds(k + 1, *time)?;
        if clock.last().is_some_and(|before| now <= *before) {
            let message = format!(
                "point {} at {time} s is less than a nanosecond after the one before, and ROS 2 would take both for one",
                k + 1
            );
            return Err(Error::not_possible(message, "leave one of them out of the motion"));
        }
        clock.push(now);
    }
    Ok(clock)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.1 + 0.2 s is a little more than 0.3 s, by far less than a nanosecond.
    #[test]
    fn a_time_is_rounded_to_its_nearest_nanosecond() {
        assert_eq!(nanoseconds(1, 0.1 + 0.2).unwrap(), 300_000_000);
        assert_eq!(duration(12_000_000_034), Duration { sec: 12, nanosec: 34 });
        for time in [-1e-9, 3e9, f64::NAN, f64::INFINITY] {
            assert!(nanoseconds(1, time).is_err());
        }
    }
}
