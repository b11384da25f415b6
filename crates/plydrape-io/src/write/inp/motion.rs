//! The grippers' motion: displacements from the flat ply, over the time of the deck.
//!
//! The deck has two steps. In the first, [`HANG`] seconds long, the ply comes to hang: gravity grows for [`LOAD`] while
//! the grippers hold the flat ply, then they go to where the result begins. In this order the ply is in tension
//! throughout. Were both to begin at once, the first push would find a ply still flat, and a solver may then follow it
//! straight into compression, which is an equilibrium but none that lasts. In the second step they follow the result's steps in its own time. Each
//! gripper has a table (`*AMPLITUDE`) for each direction in which it moves, in meters over the total time, and its
//! node set is moved by it: `x = flat place + table`. Rotations are free, as in the ball joints of the grippers.

use super::mesh::Mesh;
use super::text::{Deck, number};
use crate::result::ResultFile;
use crate::write::pose::Pose;
use plydrape::ply::{GripperId, gripper_name};

/// Time in which the ply comes to hang (s).
pub(super) const HANG: f64 = 1.0;

/// Time in which gravity grows (s), before the grippers move.
pub(super) const LOAD: f64 = 0.1;

/// The motion of one gripper.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    pub id: GripperId,
    /// Fabric point that the gripper holds (m).
    pub place: [f64; 2],
    /// Displacement from the flat ply (m) at every time of [`Tracks::times`].
    pub moves: Vec<[f64; 3]>,
}

/// The motions of all grippers over the total time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tracks {
    /// Total times (s), ascending: 0 and [`LOAD`] for the flat ply, then the result's steps.
    pub times: Vec<f64>,
    /// One for each gripper, i running fastest.
    pub tracks: Vec<Track>,
}

impl Tracks {
    /// From the flat ply through all steps of a result; a step at the time of the one before it takes its place.
    pub fn new(result: &ResultFile, pose: &Pose) -> Tracks {
        let mut times = vec![0.0, LOAD];
        let mut tracks: Vec<Track> = (result.steps.first().into_iter())
            .flat_map(|step| &step.grippers)
            .enumerate()
            .map(|(n, gripper)| Track {
                id: gripper.id,
                place: result.scene.ply.place(n),
                moves: vec![[0.0; 3]; 2],
            })
            .collect();
        let start = result.steps.first().map_or(0.0, |step| step.time);
        for step in &result.steps {
            let time = HANG + step.time - start;
            let again = times.len() > 2 && times.last().is_some_and(|last| time <= *last);
            if !again {
                times.push(time);
            }
            for (track, gripper) in tracks.iter_mut().zip(&step.grippers) {
                let flat = pose.place(track.place);
                if again {
                    track.moves.pop();
                }
                track.moves.push([0, 1, 2].map(|c| gripper.position[c] - flat[c]));
            }
        }
        Tracks { times, tracks }
    }

    /// Time of the second step (s), if there is one.
    pub fn lay_time(&self) -> Option<f64> {
        self.times.last().map(|last| last - HANG).filter(|time| *time > 0.0)
    }

    /// The node sets of the grippers, and one of all.
    pub fn node_sets(&self, mesh: &Mesh, deck: &mut Deck) {
        let mut all = Vec::new();
        for track in &self.tracks {
            let nodes = mesh.gripper(track.place);
            deck.node_set(&gripper_name(track.id), &nodes);
            all.extend(nodes);
        }
        deck.node_set("GRIPPERS", &all);
    }

    /// The tables, and gravity's: a share of it over the total time.
    pub fn amplitudes(&self, deck: &mut Deck) {
        deck.line("*AMPLITUDE, NAME=GRAVITY, TIME=TOTAL TIME");
        let end = self.times.last().copied().unwrap_or_default();
        deck.numbers([0.0, 0.0, LOAD, 1.0, 1.0 + end, 1.0]);
        for track in &self.tracks {
            for c in (0..3).filter(|c| track.moves_along(*c)) {
                deck.line(&format!(
                    "*AMPLITUDE, NAME={}, TIME=TOTAL TIME",
                    table_name(track.id, c)
                ));
                let pairs: Vec<String> = (self.times.iter().zip(&track.moves))
                    .map(|(time, step)| format!("{}, {}", number(*time), number(step[c])))
                    .collect();
                for four in pairs.chunks(4) {
                    deck.line(&four.join(", "));
                }
            }
        }
    }

    /// What holds and moves the grippers.
    pub fn boundary(&self, deck: &mut Deck) {
        for track in &self.tracks {
            for c in 0..3 {
                let (set, dof) = (gripper_name(track.id), c + 1);
                if track.moves_along(c) {
                    deck.line(&format!("*BOUNDARY, AMPLITUDE={}", table_name(track.id, c)));
                    deck.line(&format!("{set}, {dof}, {dof}, 1.0"));
                } else {
                    deck.line("*BOUNDARY");
                    deck.line(&format!("{set}, {dof}, {dof}"));
                }
            }
        }
    }
}

impl Track {
    /// Whether the gripper moves along a direction at all.
    fn moves_along(&self, c: usize) -> bool {
        self.moves.iter().any(|step| step[c] != 0.0)
    }
}

/// Name of the table of a gripper along a direction.
fn table_name(id: GripperId, c: usize) -> String {
    format!("{}_{}", gripper_name(id), ["x", "y", "z"][c])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    fn pose(result: &ResultFile) -> Pose {
        let ply = &result.scene.ply;
        let flat: Vec<[f64; 2]> = (0..ply.grippers()).map(|n| ply.place(n)).collect();
        Pose::start(result, &flat, |gripper| gripper.position).unwrap()
    }

    /// Flat place and table add up to the gripper's position in every step; before them is the flat ply.
    #[test]
    fn tables_lead_from_the_flat_ply_through_all_steps() {
        let result = sample::draped(4, 2, 7);
        let pose = pose(&result);
        let tracks = Tracks::new(&result, &pose);
        assert_eq!(tracks.times.len(), 9);
        for (k, track) in tracks.tracks.iter().enumerate() {
            assert_eq!(track.moves[..2], [[0.0; 3]; 2]);
            let flat = pose.place(track.place);
            for (step, moved) in result.steps.iter().zip(&track.moves[2..]) {
                let due = step.grippers[k].position;
                assert!((0..3).all(|c| (flat[c] + moved[c] - due[c]).abs() < 1e-15));
            }
        }
        assert_eq!(tracks.lay_time(), Some(1.0), "the sample takes a second");
    }

    /// The flat ply is 2 mm a cell longer than the grippers are apart: those at the ends go 3 mm inwards.
    #[test]
    fn grippers_of_a_hanging_ply_go_inwards_only() {
        let result = sample::hanging(4, 2);
        let tracks = Tracks::new(&result, &pose(&result));
        assert_eq!(tracks.lay_time(), None);
        for track in &tracks.tracks {
            let [i, j] = track.id.map(|n| n as f64);
            let due = [-0.002 * (i - 1.5), -0.002 * (j - 0.5), 0.0];
            assert!((0..3).all(|c| (track.moves[2][c] - due[c]).abs() < 1e-15), "{track:?}");
        }
    }

    /// Two steps at one time would be a jump, which a table cannot hold: the later one counts.
    #[test]
    fn times_of_a_table_ascend() {
        let mut result = sample::draped(2, 2, 4);
        result.steps[2].time = result.steps[1].time;
        let pose = pose(&result);
        let tracks = Tracks::new(&result, &pose);
        assert!(tracks.times.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(tracks.tracks.iter().all(|track| track.moves.len() == tracks.times.len()));
        let flat = pose.place([0.0, 0.0]);
        assert_eq!(tracks.tracks[0].moves[3][2], result.steps[2].grippers[0].position[2] - flat[2]);
    }
}
