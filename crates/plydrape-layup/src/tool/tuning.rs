//! Numbers that no theory gives.

/// Largest angular speed (°/s) and acceleration (°/s²) of a frame unless a scene says otherwise: a large robot that carries a frame
/// in a cell with people nearby turns no faster. Our assumption, from no data sheet.
pub const TURN: [f64; 2] = [45.0, 180.0];

/// What a stroke costs beside a residual of the same length. Where some pose leaves no residual, the pose with the smallest
/// strokes is taken; the square of this is the share of a stroke that may be left as a residual.
pub const STROKE_COST: f64 = 1e-4;

/// Most Newton steps to a posture, and most halvings of one.
pub const STEPS: usize = 60;
/// See [`STEPS`].
pub const HALVINGS: usize = 20;

/// A step this small, of the array's size, ends the search for a posture.
pub const CONVERGED: f64 = 1e-13;

/// Share of the largest pivot below which a direction is not held by the grippers, as the turn of a strip about itself.
pub const FREE: f64 = 1e-14;

/// Share of the largest eigenvalue of Horn's matrix by which it must exceed the next one for a turn to be held by the grippers: from there on
/// rounding turns the frame by less than 1e-9, which the next search takes away.
pub const OPEN: f64 = 1e-6;

/// Share of a cost that is rounding: near the least cost a step cannot be told to be worse.
pub const ROUNDING: f64 = 1e-12;

/// Mean slope of the mounts along an axis up to which it lifts grippers off their plane: a pattern that is shorter by the half of its square could
/// still be met by tilts to both sides.
pub const LIFTS: f64 = 0.1;

/// A frame tips over where it turns by more than this angle (rad) from one step to the next, and would thereby move its farthest gripper by more than
/// this times what any gripper moves: a rigid body that turns moves as far as it turns, and strokes take up some of it.
pub const TIPS: [f64; 2] = [0.035, 1.5];

/// A change of the frame this small (rad, and of the array's size) ends the search where strokes of an axis that lifts are at their ends.
pub const SETTLED: f64 = 1e-9;

/// How much of its cost a stroke keeps from one of these steps to the next: so few strokes come to their ends in one of them that the next finds
/// which.
pub const CHEAPER: f64 = 0.5;
