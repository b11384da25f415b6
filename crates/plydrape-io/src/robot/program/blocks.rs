//! The points of a program between its stops, and how each is passed.
//!
//! The cell stops where the vacuum switches, where it rests, and at its end. Between two stops a controller passes each
//! point in a zone around it, in which it turns from one straight way into the next along a parabola. With the ways that
//! lie within the zone before and behind the point, p and q, the parabola passes the point at the distance |q − p| / 4.

use super::sampling::{Deviation, Sampling, Tolerance, Track, largest, nearest};
use super::spline;
use plydrape::geometry::vector::{norm, sub};

/// A point and how it is passed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Passed {
    /// Which sample it is.
    pub sample: usize,
    /// How long the way to it takes (s).
    pub duration: f64,
    /// Radius of the zone in which it is passed (m); 0 where the cell stops.
    pub radius: f64,
}

/// The points up to a stop, and what happens there.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Block {
    /// The points behind the one at which the block before ended.
    pub points: Vec<Passed>,
    /// Events at the last one, by their numbers.
    pub events: Vec<usize>,
    /// How long the cell rests there then (s).
    pub wait: f64,
}

/// A program in blocks.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Blocks {
    /// What happens at the first point; it has no points.
    pub start: Block,
    pub blocks: Vec<Block>,
    /// The largest error of straight lines between the points, each sample at its own time.
    pub error: Deviation,
    /// The largest distance (m) and angle (rad) at which lines, or the splines through the points, pass the motion.
    pub passing: Deviation,
    /// The largest distance at which a point is passed (m).
    pub corner: f64,
    /// The tolerance of both.
    pub tolerance: Tolerance,
}

impl Blocks {
    /// The blocks of a track within a tolerance, with zones of some radii (m), of which the first is the smallest; or with splines through the points.
    pub fn new(track: &Track, tolerance: &Tolerance, radii: &[f64], splines: bool) -> Self {
        let program = track.program;
        let times = &program.times;
        let at: Vec<usize> = program.events.iter().map(|e| nearest(times, e.time)).collect();
        let stops = track.stops(&at, tolerance);
        let Sampling { mut kept, mut error } = track.sampling(&stops, tolerance);
        let passing = match splines {
            true => {
                let passing = spline::refine(track, &stops, &mut kept, tolerance);
                error = largest(&kept, |a, b, k| track.deviation(a, b, k));
                passing
            }
            false => largest(&kept, |a, b, k| track.passing(a, b, k)),
        };
        let events = |sample: usize| -> Vec<usize> {
            (0..at.len()).filter(|event| at[*event] == sample).collect()
        };

        // a block ends at events, and before a rest
        let mut blocks = vec![Block { events: events(0), ..Block::default() }];
        let mut open = false;
        for pair in kept.windows(2) {
            let duration = times[pair[1]] - times[pair[0]];
            let found = events(pair[1]);
            let rests = track.rests(pair[0], pair[1], tolerance);
            if rests {
                open = false;
                // the list begins with the start
                if let Some(last) = blocks.last_mut() {
                    last.wait += duration;
                }
                if !found.is_empty() {
                    blocks.push(Block { events: found, ..Block::default() });
                }
                continue;
            }
            if !open {
                blocks.push(Block::default());
            }
            open = found.is_empty();
            if let Some(last) = blocks.last_mut() {
                last.points.push(Passed { sample: pair[1], duration, radius: 0.0 });
                last.events = found;
            }
        }

        let mut corner: f64 = 0.0;
        let mut from = 0;
        for block in &mut blocks {
            for n in 0..block.points.len() {
                let sample = block.points[n].sample;
                if let Some(next) = block.points.get(n + 1).map(|next| next.sample) {
                    let (radius, distance) =
                        zone(track, [from, sample, next], tolerance.position, radii);
                    block.points[n].radius = radius;
                    corner = corner.max(distance);
                }
                from = sample;
            }
        }
        let start = blocks.remove(0);
        Blocks { start, blocks, error, passing, corner, tolerance: *tolerance }
    }

    /// Numbers of points, the start not among them.
    pub fn points(&self) -> usize {
        self.blocks.iter().map(|block| block.points.len()).sum()
    }

    /// The shortest time between two points (s), if there are any.
    pub fn shortest(&self) -> Option<f64> {
        let points = self.blocks.iter().flat_map(|block| &block.points);
        points.map(|point| point.duration).reduce(f64::min)
    }

    /// The blocks in parts of at most this many points. A longer block is cut, and the cell stops there.
    pub fn parts(&self, most: usize) -> Vec<Vec<Block>> {
        let (mut parts, mut part) = (Vec::new(), Vec::new());
        let mut room = most;
        for block in &self.blocks {
            let mut points = &block.points[..];
            if points.len() > room && room < most {
                parts.push(std::mem::take(&mut part));
                room = most;
            }
            while points.len() > room {
                let (now, later) = points.split_at(room);
                let mut cut = Block { points: now.to_vec(), ..Block::default() };
                if let Some(last) = cut.points.last_mut() {
                    last.radius = 0.0;
                }
                part.push(cut);
                parts.push(std::mem::take(&mut part));
                (points, room) = (later, most);
            }
            room -= points.len();
            part.push(Block { points: points.to_vec(), ..block.clone() });
        }
        parts.push(part);
        parts
    }
}

/// The zone in which the tool turns and external axes move is wider than that of the center by this factor at most: `pzone_ori` and
/// `pzone_eax` of ABB's zones are up to 1.6 times `pzone_tcp` (technical reference manual 3HAC050917, `zonedata`).
const WIDER: f64 = 1.6;

/// The largest radius of the zone of a sample between two others, and the distance at which it is passed (m), both at most
/// as large as they may be. The smallest radius is always taken: a controller makes it as small as it needs.
fn zone(track: &Track, [from, at, to]: [usize; 3], most: f64, radii: &[f64]) -> (f64, f64) {
    let lengths = [track.distance(from, at), track.distance(at, to)];
    let half = 0.5 * lengths[0].min(lengths[1]);
    let distance = |radius: f64| {
        let shares = |radius: f64| {
            let within = radius.min(half);
            lengths.map(|length| if length > 0.0 { within / length } else { 0.0 })
        };
        let change = |shares: [f64; 2], [before, now, then]: [[f64; 3]; 3]| {
            let [p, q] = [sub(now, before), sub(then, now)];
            norm([0, 1, 2].map(|n| 0.25 * (shares[1] * q[n] - shares[0] * p[n])))
        };
        let near = shares(radius);
        let center = track
            .center
            .as_ref()
            .map_or(0.0, |center| change(near, [from, at, to].map(|k| center[k].position)));
        // the pads have in them what turns and what the axes do
        let wide = shares(WIDER * radius);
        let pads = track
            .program
            .pads
            .iter()
            .map(|pad| change(wide, [from, at, to].map(|k| pad.poses[k].position)));
        // axes of another controller are where they belong to a progress that is passed by as well
        let late = match track.moves_axes {
            true => 0.0,
            false => {
                let [p, q, r] = [from, at, to].map(|k| track.progress[k]);
                let slip = 0.25 * (wide[1] * (r - q) - wide[0] * (q - p));
                track.largest(|axis| track.followed(axis, q + slip) - track.followed(axis, q))
            }
        };
        let own = track.largest(|axis| {
            let values = &track.program.axes[axis].values;
            let [p, q, r] = [values[from], values[at], values[to]];
            0.25 * (wide[1] * (r - q) - wide[0] * (q - p))
        });
        let own = if track.program.pads.is_empty() { own } else { 0.0 };
        pads.fold(center.max(own), f64::max) + late
    };
    let fits =
        radii.iter().skip(1).rev().find(|radius| **radius <= half && distance(**radius) <= most);
    let radius = fits.or(radii.first()).copied().unwrap_or_default();
    (radius, distance(radius))
}
