//! How the ply is brought from the flat to rest: along the motion of the grippers, in time steps.
//!
//! The motion is stretched in time until the speed of the grippers is of no matter (or taken as it is), and followed in
//! shares of its steps: a share that is not solved is halved, one that is solved easily is followed by a longer one. Pads
//! let go on the way or after it, as the layup says.

use super::Sheet;
use super::cloth::Cloth;
use super::drape::Status;
use super::energy::Phase;
use super::newton::Failure;
use super::release::Releases;
use super::tuning::SheetTuning;
use crate::geometry::vector::{between, distance};
use crate::layup::{Layup, SheetTime};

/// Share of a step of the motion that is no time.
const ROUNDING: f64 = 1e-6;

/// Why a motion was not followed to its end.
pub enum Ended {
    /// A time step could not be solved.
    NotSolved,
    /// The caller stopped it.
    Stopped,
}

impl Ended {
    /// The status of a drape that ended so.
    pub fn status(&self) -> Status {
        match self {
            Ended::NotSolved => Status::NotSolved,
            Ended::Stopped => Status::Interrupted,
        }
    }
}

/// A ply on its way along a motion.
pub struct March<'a> {
    /// The ply.
    pub cloth: Cloth<'a>,
    /// When pads let go; `None` if they hold to the end.
    pub releases: Option<Releases<'a>>,
    /// Time steps that were solved.
    pub time_steps: usize,
    /// Smallest share of a step of the motion that was solved.
    pub smallest_step: f64,
    sheet: &'a Sheet,
    tuning: SheetTuning,
    /// What the time of the motion is.
    time: SheetTime,
    /// Whether to stop, asked before each time step.
    stop: &'a dyn Fn() -> bool,
    /// Where grippers go in the next time step (m).
    targets: Vec<[f64; 3]>,
    /// Share of a step of the motion that the next time step tries.
    share: f64,
}

impl<'a> March<'a> {
    /// A ply that is about to be hung.
    pub fn new(
        layup: &Layup,
        sheet: &'a Sheet,
        tuning: SheetTuning,
        cloth: Cloth<'a>,
        releases: Option<Releases<'a>>,
        stop: &'a dyn Fn() -> bool,
    ) -> Self {
        March {
            targets: cloth.now.pads.iter().map(|pad| pad.position).collect(),
            cloth,
            releases,
            time_steps: 0,
            smallest_step: 1.0,
            sheet,
            tuning,
            time: layup.settings.sheet.time,
            stop,
            share: 1.0,
        }
    }

    /// Whether the caller stops the drape.
    pub fn is_stopped(&self) -> bool {
        (self.stop)()
    }

    /// Hangs the flat ply at its start: moves the grippers from where they are placed to their starts (m). What comes to the mold there
    /// lies on it, and does not rub.
    ///
    /// # Errors
    /// If a time step is not solved, or the caller stops.
    pub fn hang(&mut self, placed: &[[f64; 3]], start: &[[f64; 3]]) -> Result<(), Ended> {
        let hung = self.pass(Phase::Hang, placed, start, None);
        self.cloth.phase = Phase::Rest;
        hung
    }

    /// Moves the grippers from one place to another (m), in a step of the motion between two times (s).
    ///
    /// # Errors
    /// If a time step is not solved, or the caller stops.
    pub fn follow(
        &mut self,
        from: &[[f64; 3]],
        to: &[[f64; 3]],
        times: [f64; 2],
    ) -> Result<(), Ended> {
        self.pass(Phase::Follow, from, to, Some(times))
    }

    /// Moves the grippers from one place to another (m) in a phase, in a step of the motion between two times (s) if it is one.
    fn pass(
        &mut self,
        phase: Phase,
        from: &[[f64; 3]],
        to: &[[f64; 3]],
        times: Option<[f64; 2]>,
    ) -> Result<(), Ended> {
        self.cloth.phase = phase;
        let way = from.iter().zip(to).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
        let [duration, longest] = self.durations(way, times);
        let tolerance = self.tuning.step_tolerance * self.sheet.mesh;
        let mut done = 0.0;
        // a motion in its own time needs this many steps at least
        let mut tries = self.tuning.tries + (2.0 * duration / longest) as usize;
        while done < 1.0 {
            if self.is_stopped() {
                return Err(Ended::Stopped);
            }
            if tries == 0 {
                return Err(Ended::NotSolved);
            }
            tries -= 1;

            // a pad lets go at the end of its dwell, not later
            let (next, share) = self.next_share(done, way, [duration, longest]);
            let due =
                self.due(times).filter(|due| (done + ROUNDING..next - ROUNDING).contains(due));
            let (next, share) = due.map_or((next, share), |due| (due, due - done));

            for (target, (a, b)) in self.targets.iter_mut().zip(from.iter().zip(to)) {
                *target = between(*a, *b, next);
            }
            match self.cloth.advance(&self.targets, share * duration, tolerance) {
                Ok(iterations) => {
                    self.time_steps += 1;
                    self.smallest_step = self.smallest_step.min(share);
                    done = next;
                    if let Some([begin, end]) = times {
                        self.let_go(begin + done * (end - begin), ROUNDING * (end - begin));
                    }
                    if iterations <= self.tuning.easy_iterations {
                        self.share = (2.0 * self.share).min(1.0);
                    }
                }
                Err(failure) => {
                    let SheetTuning { turn: most, turn_margin, turn_retry, .. } = self.tuning;
                    let shorter = match failure {
                        Failure::Turn(turn) => (turn_margin * most / turn).clamp(turn_retry, 0.5),
                        _ => 0.5,
                    };
                    self.share = shorter * share;
                    if share <= self.tuning.smallest_step && due.is_none() {
                        return Err(Ended::NotSolved);
                    }
                }
            }
        }
        Ok(())
    }

    /// The share of a step of the motion at which the next time step ends, and how long it is as a share, where a share is
    /// done, the grippers go a way (m) in all, and the step and the longest time step take these times (s).
    fn next_share(&mut self, done: f64, way: f64, [duration, longest]: [f64; 2]) -> (f64, f64) {
        let most = self.share.min(1.0 - done).min(longest / duration);
        let least = self.tuning.contact_way * self.sheet.pitch / way;
        let share = (self.cloth.longest_step(most * duration) / duration).max(least).min(most);
        // steps of one length to the end
        let share = (1.0 - done) / ((1.0 - done) / share - 1e-9).ceil();
        let next = if done + share > 1.0 - 1e-9 { 1.0 } else { done + share };
        (next, share)
    }

    /// Time (s) of a step in which grippers go a way (m), and the longest time step in it (s): the time of the motion, or as
    /// slowly as the ply's kinetic energy wants it.
    fn durations(&self, way: f64, times: Option<[f64; 2]>) -> [f64; 2] {
        match (self.time, times) {
            (SheetTime::Real, Some([begin, end])) => {
                let swing = (self.sheet.pitch / self.sheet.gravity).sqrt();
                [end - begin, self.tuning.real_step * swing]
            }
            _ => [self.stretched(way), f64::INFINITY],
        }
    }

    /// Time (s) in which grippers go so far (m) that the ply's kinetic energy is of no matter; where they stand, that of a
    /// pitch.
    fn stretched(&self, way: f64) -> f64 {
        let lift = self.tuning.lift * self.sheet.pitch;
        let speed = (2.0 * self.sheet.gravity * lift).sqrt();
        (way / speed).max(lift / speed)
    }

    /// Share of a step between two times (s) at which the next pad lets go, if what lies goes on lying.
    fn due(&self, times: Option<[f64; 2]>) -> Option<f64> {
        let (due, [begin, end]) = (self.releases.as_ref()?.due()?, times?);
        Some((due - begin) / (end - begin))
    }

    /// Lets go at a time (s) with the pads that are due by then, give or take the rounding (s).
    fn let_go(&mut self, time: f64, rounding: f64) {
        let Some(releases) = &mut self.releases else { return };
        let gone = releases.come_to(time, rounding);
        if !gone.is_empty() {
            self.cloth.release(&gone);
        }
    }

    /// Lets go with all pads that still hold at the end of the motion; returns when they do (s), `None` if they hold on.
    pub fn let_go_of_all(&mut self) -> Option<f64> {
        let (all, time) = self.releases.as_mut()?.end();
        self.cloth.release(&all);
        Some(time)
    }

    /// Holds the grippers at places (m) until nothing moves any more; returns whether that is so. A ply that may fall (`falls`) goes no farther
    /// in a time step than it is from the mold.
    pub fn rest(&mut self, places: &[[f64; 3]], falls: bool) -> bool {
        let tolerance = self.tuning.rest_tolerance * self.sheet.mesh;
        // as long as what moves it takes to end: gravity, and resin
        let relaxed = self.tuning.relaxed * self.cloth.energies.shear.relaxation();
        let longest = self.stretched(self.sheet.pitch).max(relaxed);
        self.cloth.phase = Phase::Rest;
        let mut dt = 0.01 * longest;
        if falls {
            // the time of a fall by the way that a node may land with
            dt = dt.min((self.tuning.contact_way * self.sheet.pitch / self.sheet.gravity).sqrt());
        }
        for _ in 0..self.tuning.rest_steps {
            if self.is_stopped() {
                return false;
            }
            if falls {
                dt = self.cloth.longest_step(dt);
            }
            match self.cloth.advance(places, dt, tolerance) {
                Ok(iterations) => {
                    self.time_steps += 1;
                    let still =
                        self.cloth.movement() <= self.tuning.rest_movement * self.sheet.mesh;
                    if still && dt >= longest {
                        return true;
                    }
                    let longer = if iterations == 1 { 3.0 } else { 2.0 };
                    dt = (longer * dt).min(longest);
                }
                Err(_) => dt *= 0.25,
            }
        }
        false
    }
}
