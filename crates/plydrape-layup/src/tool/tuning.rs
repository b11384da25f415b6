//! Numbers that no theory gives.

/// Largest angular speed (°/s) and acceleration (°/s²) of a frame unless a scene says otherwise: a large robot that carries a frame
/// in a cell with people nearby turns no faster. Our assumption, from no data sheet.
pub const TURN: [f64; 2] = [45.0, 180.0];

/// Share of the residual which a scene allows that is spent before the longest stroke is: what is left is for everything else that is off.
pub const SPENT: f64 = 0.1;

/// Share of the smallest distance of two mounts that is spent so where a scene says nothing of a residual.
pub const SPENT_OF_PITCH: f64 = 1e-3;

/// Least and largest cost of a stroke beside a residual of the same length. Where some pose leaves no residual, the square of this is the share
/// of a stroke that may be left as one: at most 1e-4. A smaller cost than the least would be rounding.
pub const STROKE_COST: [f64; 2] = [1e-4, 1e-2];

/// Most Newton steps to a posture, and most steps of a linear problem.
pub const STEPS: usize = 100;

/// Halvings of the range in which the least along a step lies: what is left is below the rounding of a step.
pub const BISECTIONS: usize = 50;

/// A step this small, of the array's size, ends the search for a posture.
pub const CONVERGED: f64 = 1e-12;

/// Share of the largest pivot below which a direction is not held by the grippers, as the turn of a strip about itself.
pub const FREE: f64 = 1e-14;

/// Share of the largest eigenvalue of Horn's matrix by which it must exceed the next one for a turn to be held by the grippers: from there on
/// rounding turns the frame by less than 1e-9, which the next search takes away.
pub const OPEN: f64 = 1e-6;

/// A frame tips over where it turns by more than this angle (rad) from one step to the next, and would thereby move its farthest gripper by more than
/// this times what any gripper moves: a rigid body that turns moves as far as it turns, and strokes take up some of it.
pub const TIPS: [f64; 2] = [0.035, 1.5];
