//! Numbers that no theory gives.

/// Least singular value of the flange's motion by the joints, with lengths in units of the reach, that a scene accepts unless it says
/// otherwise: below it joints are twenty times as fast as the flange turns. Our assumption.
pub const LEAST_SINGULAR: f64 = 0.05;

/// Least distance of a joint from its ends (rad) unless a scene says otherwise: controllers are usually set up with software limits a few
/// degrees inside of the mechanical ones. Our assumption.
pub const LEAST_MARGIN: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// A pose is reached where what is left of it is below this share of the reach of the arm: a nanometer or two.
pub const REACHED: f64 = 1e-9;

/// Two arms are as free where their distance from limits differs by less than this share of it.
pub const ROUNDING: f64 = 1e-6;

/// What an arm may miss of a pose, as a share of its reach: two thousandths of a millimeter of an arm of two meters.
pub const ALLOWED: f64 = 1e-6;

/// Two lists of angles (rad) are one configuration where they differ by less.
pub const SAME: f64 = 1e-4;

/// Angles, as shares of a full turn, that the search for configurations begins with, joint by joint after the first. Arms have their shoulder
/// and elbow folded or stretched to either side, and the wrist turned over.
pub const STARTS: [&[f64]; 5] = [
    &[-0.375, -0.25, -0.125, 0.0, 0.125, 0.25],
    &[-0.375, -0.25, -0.125, 0.125, 0.25, 0.375],
    &[0.0, 0.5],
    &[-0.2, 0.2],
    &[0.0, 0.5],
];

/// Between two poses joints may turn by this angle (rad) before poses between them are followed too, halved up to so often: a smaller
/// one keeps the same configuration.
pub const FAR: f64 = 0.2;
/// See [`FAR`].
pub const HALVINGS: u32 = 8;
