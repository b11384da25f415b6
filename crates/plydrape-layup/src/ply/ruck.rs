//! The ruck that slack makes where a ply lies: a heavy sheet on a floor, lifted off it over a short length.
//!
//! Where it is off the floor the sheet obeys `D w'''' + P w'' = −q`, D its flexural rigidity, q its weight, P the pressing
//! force, and it leaves the floor with `w = w' = w'' = 0` at ±a. With k² = P/D the condition on the slope is
//! `tan ka = ka`, so ka = 4.4934…, whatever the sheet, and
//!
//! ```text
//! w(x) = C (cos kx − cos ka + ½ c k² (a² − x²)) ,   c = −cos ka = 0.21723… ,   q = c C k⁴ D .
//! ```
//!
//! Height h = w(0), slack s = ½∫w'² and steepest slope follow. With l³ = D/q they give
//! h = 1.3256 l^(3/7) s^(4/7), after Kolinski, Aussillous and Mahadevan 2009 and Vella, Boudaoud and Adda-Bedia 2009 in substance; small slopes.

/// First positive root of tan x = x: half the width of a ruck times its wave number.
const HALF_WIDTH: f64 = 4.493_409_457_909_064;
/// −cos of [`HALF_WIDTH`]: its inverse is √(1 + x²).
const COSINE: f64 = 0.217_233_628_211_221_7;
/// w(0)/C.
const HEIGHT: f64 = 1.0 + COSINE + 0.5 * COSINE * HALF_WIDTH * HALF_WIDTH;

/// A ruck of small slopes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ruck {
    /// Amplitude C (m).
    amplitude: f64,
    /// Wave number k (1/m).
    wave_number: f64,
}

impl Ruck {
    /// The ruck of a slack s (m) in a line of flexural rigidity EI (N·m²) and weight per length (N/m); `None` without
    /// slack, or in a line without rigidity, which crumples instead.
    #[must_use]
    pub fn from_slack(slack: f64, flexural_rigidity: f64, weight: f64) -> Option<Ruck> {
        if !(slack > 0.0 && flexural_rigidity > 0.0 && weight > 0.0) {
            return None;
        }
        // s = C² k J with J = ∫₀^ka (sin y + c y)² dy, and k⁴ = q/(c C D)
        let x = HALF_WIDTH;
        let integral = 0.5 * x - 0.25 * (2.0 * x).sin() + COSINE * COSINE * x.powi(3) / 3.0;
        let cubed = flexural_rigidity / weight;
        let amplitude = (slack / integral).powf(4.0 / 7.0) * (COSINE * cubed).powf(1.0 / 7.0);
        let wave_number = (COSINE * amplitude * cubed).powf(-0.25);
        Some(Ruck { amplitude, wave_number })
    }

    /// The ruck that a free edge of a length L (m) leaves on a mold to which it sticks, beside a gripper that comes down upright.
    ///
    /// The edge hangs as a clamped beam under its own weight: its end is turned by θ = qL³/6D, and comes to the mold first, short of its place by
    /// ½∫w'² = 9θ²L/28. This slack stays. The height of the ruck goes as L⁴, its slope as L³.
    #[must_use]
    pub fn of_free_edge(length: f64, flexural_rigidity: f64, weight: f64) -> Option<Ruck> {
        let turn = weight * length.powi(3) / (6.0 * flexural_rigidity);
        Ruck::from_slack(9.0 / 28.0 * turn * turn * length, flexural_rigidity, weight)
    }

    /// Height above the floor (m).
    #[must_use]
    pub fn height(&self) -> f64 {
        HEIGHT * self.amplitude
    }

    /// Height (m) at a distance from its middle (m).
    #[must_use]
    pub fn height_at(&self, x: f64) -> f64 {
        let y = self.wave_number * x;
        if y.abs() >= HALF_WIDTH {
            return 0.0;
        }
        let square = HALF_WIDTH * HALF_WIDTH - y * y;
        self.amplitude * (y.cos() + COSINE + 0.5 * COSINE * square)
    }

    /// Steepest angle (rad).
    #[must_use]
    pub fn steepest(&self) -> f64 {
        // w' = −Ck (sin y + c y) is steepest where cos y = −c
        let y = (-COSINE).acos();
        (self.amplitude * self.wave_number * (y.sin() + COSINE * y)).atan()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's line, 9e-6 N·m² and 0.3143 kg/m.
    const RIGIDITY: f64 = 9e-6;
    const WEIGHT: f64 = 0.3143 * 9.8;

    /// The shape is held by the floor at its ends only, bends as a heavy beam under P, and has the slack that
    /// it was made from; by differences and sums of its points alone.
    #[test]
    fn a_ruck_is_a_heavy_beam_that_leaves_the_floor_smoothly() {
        for slack in [1e-6, 1e-5, 1e-4] {
            let ruck = Ruck::from_slack(slack, RIGIDITY, WEIGHT).unwrap();
            let a = HALF_WIDTH / ruck.wave_number;
            let h = a / 200.0;
            let w = |n: i32| ruck.height_at(h * f64::from(n));
            let second = |n: i32| (w(n + 1) - 2.0 * w(n) + w(n - 1)) / (h * h);
            let fourth = |n: i32| (second(n + 1) - 2.0 * second(n) + second(n - 1)) / (h * h);
            // P from one place holds at all others
            let pressing = -(WEIGHT + RIGIDITY * fourth(0)) / second(0);
            for n in [-150, -90, 40, 120, 180] {
                let left = RIGIDITY * fourth(n) + pressing * second(n) + WEIGHT;
                assert!(left.abs() < 2e-3 * WEIGHT, "{slack} {n}: {left}");
            }
            let scale = ruck.height() / (a * a);
            assert!(w(200).abs() < 1e-12 && (w(199) / h).abs() < 0.01 * scale * a);
            assert!(second(199).abs() < 0.2 * scale, "{}", second(199));
            let length: f64 = (-200..200).map(|n| 0.5 * (w(n + 1) - w(n)).powi(2) / h).sum();
            assert!((length / slack - 1.0).abs() < 1e-3, "{length} {slack}");
            let slopes = (-200..200).map(|n| ((w(n + 1) - w(n)) / h).atan());
            let steepest = slopes.fold(0.0, f64::max);
            assert!((steepest / ruck.steepest() - 1.0).abs() < 1e-3);
        }
    }

    /// 4.1 mm·(s/mm)^(4/7) for the paper's ply, within the 5 % that the law is known to.
    #[test]
    fn a_millimeter_of_slack_in_the_papers_ply_rises_by_four() {
        for slack in [0.1_f64, 1.0, 3.0] {
            let height = Ruck::from_slack(slack * 1e-3, RIGIDITY, WEIGHT).unwrap().height() * 1e3;
            let printed = 4.1 * slack.powf(4.0 / 7.0);
            assert!((height / printed - 1.0).abs() < 0.05, "{slack}: {height} {printed}");
        }
    }

    /// The shortening of a free edge is that of a clamped beam, summed over its slope w' = θ(1 − (1 − x/L)³), and a ruck of an edge twice as
    /// long is 16 times as high and 8 times as steep.
    #[test]
    fn a_free_edge_leaves_the_ruck_of_its_shortening() {
        let (length, rigidity, weight) = (0.02, 9e-5, 3.0);
        let turn = weight * length * length * length / (6.0 * rigidity);
        let slope = |x: f64| turn * (1.0 - (1.0 - x / length).powi(3));
        let step = length / 1e4;
        let short: f64 =
            (0..10_000).map(|n| 0.5 * slope((n as f64 + 0.5) * step).powi(2) * step).sum();
        let [found, summed] = [
            Ruck::of_free_edge(length, rigidity, weight).unwrap(),
            Ruck::from_slack(short, rigidity, weight).unwrap(),
        ];
        assert!((found.height() / summed.height() - 1.0).abs() < 1e-7);
        let twice = Ruck::of_free_edge(2.0 * length, rigidity, weight).unwrap();
        assert!((twice.height() / found.height() - 16.0).abs() < 1e-9);
        assert!((twice.steepest().tan() / found.steepest().tan() - 8.0).abs() < 1e-9);
    }
}
