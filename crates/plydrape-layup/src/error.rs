//! What can be wrong with a mold, a ply, its ideal drape or a motion.

use crate::gripper::{GripperId, gripper_name};

/// Why there is no mold, outline, ideal drape or motion, or why positions of grippers have no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A height grid has fewer nodes than a cubic spline needs.
    #[error("the grid has {nx} × {ny} nodes, and a smooth surface needs 4 × 4 or more")]
    HeightGridTooFew {
        /// Nodes along x.
        nx: usize,
        /// Nodes along y.
        ny: usize,
    },
    /// A height grid has not one height for every node.
    #[error("{found} heights were given for {wanted} nodes")]
    HeightGridCount {
        /// Heights that were given.
        found: usize,
        /// Nodes of the grid.
        wanted: usize,
    },
    /// Places along an axis of a height grid do not ascend.
    #[error("the places along an axis do not ascend from {before} m to {after} m")]
    HeightGridNotAscending {
        /// A place (m).
        before: f64,
        /// The place behind it (m).
        after: f64,
    },
    /// A place or a height of a height grid is not finite.
    #[error("a place or a height is not finite")]
    HeightGridNotFinite,

    /// A layer has no thickness.
    #[error("a layer is {thickness_mm} mm thick: its thickness must be positive")]
    LayerThickness {
        /// What was given (mm).
        thickness_mm: f64,
    },
    /// A layer has no region.
    #[error(
        "a layer has no region: {rings} rings, of three or more points with finite coordinates each"
    )]
    LayerRegion {
        /// Rings that were given.
        rings: usize,
    },

    /// The file of a mesh is in order and has no surface.
    #[error("no {noun}s{others}")]
    MeshEmpty {
        /// What its surface would be made of.
        noun: &'static str,
        /// What there is instead.
        others: String,
    },
    /// A triangle of a mesh has a vertex that there is not.
    #[error("triangle {triangle} has vertex {vertex}, and the mesh has {vertices} vertices")]
    MeshVertex {
        /// Which triangle, counted from 1.
        triangle: usize,
        /// The index of a vertex, counted from 0.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// No triangle of a mesh has an area.
    #[error("none of the {triangles} triangles has an area; the mesh spans {size:.4} m")]
    MeshNoArea {
        /// How many triangles there are.
        triangles: usize,
        /// Diagonal of the box around all vertices (m).
        size: f64,
    },
    /// A mesh is too small or too large for a mold.
    #[error("the mesh spans {size:.3e} m at {scale} m per unit, expected 1e-4 to 1e5 m")]
    MeshSize {
        /// Diagonal of the box around all vertices (m).
        size: f64,
        /// Meters per unit of the file.
        scale: f64,
    },
    /// The scale of a mesh is no positive number.
    #[error("a scale of {scale} m per unit, expected a positive number such as 0.001 for mm")]
    MeshScale {
        /// Meters per unit of the file.
        scale: f64,
    },
    /// Three or more triangles of a mesh share an edge.
    #[error(
        "{noun}s {}, {} and {} share an edge near ({:.4}, {:.4}, {:.4}) m",
        .numbers[0], .numbers[1], .numbers[2], .place[0], .place[1], .place[2]
    )]
    MeshBranching {
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Three that share the edge, as numbered in the file.
        numbers: [u64; 3],
        /// Middle of the edge (m).
        place: [f64; 3],
    },
    /// A mesh has one side only, like a Möbius strip.
    #[error(
        "the surface has one side only, as a Möbius strip: it meets itself upside down at {} near ({:.4}, {:.4}, {:.4}) m",
        pair(.noun, .numbers), .place[0], .place[1], .place[2]
    )]
    MeshOneSided {
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Two that contradict each other, as numbered in the file.
        numbers: [u64; 2],
        /// Middle of their common edge (m).
        place: [f64; 3],
    },
    /// An open surface of a mesh faces neither up nor down, so its side for the ply is unknown.
    #[error(
        "the open surface of {triangles} triangles at {noun} {number} faces sideways (mean of its normals: z = {upwards:.4}), the ply comes from above"
    )]
    MeshSideways {
        /// What the surface is made of in this format.
        noun: &'static str,
        /// First one, as numbered in the file.
        number: u64,
        /// How many triangles it has.
        triangles: usize,
        /// Vertical component of the mean of its normals, weighted by area.
        upwards: f64,
    },

    /// A ring of an outline has fewer than three points.
    #[error(
        "{} has {points} different points: a closed line that bounds an area needs three or more",
        ring_name(*.ring)
    )]
    OutlineTooFew {
        /// The ring: 0 for the boundary, n for the n-th hole.
        ring: usize,
        /// Points.
        points: usize,
    },
    /// A coordinate of an outline is no number.
    #[error("{} has no finite number for point {point}, counted from 1", ring_name(*.ring))]
    OutlineNotFinite {
        /// The ring: 0 for the boundary, n for the n-th hole.
        ring: usize,
        /// The point, counted from 1.
        point: usize,
    },
    /// Two lines of an outline meet other than end to end.
    #[error("{} at ({:.3}, {:.3}) mm", crossing(*.a, *.b), at[0] * 1e3, at[1] * 1e3)]
    OutlineCrosses {
        /// One ring: 0 for the boundary, n for the n-th hole.
        a: usize,
        /// The other ring, or the same.
        b: usize,
        /// Where (m).
        at: [f64; 2],
    },
    /// A ring of an outline bounds no area to speak of.
    #[error("{} bounds no area", ring_name(*.ring))]
    OutlineFlat {
        /// The ring: 0 for the boundary, n for the n-th hole.
        ring: usize,
    },
    /// A hole of an outline is not in the ply.
    #[error(
        "{} at ({:.3}, {:.3}) mm is not inside the boundary, or lies inside another hole",
        ring_name(*.ring), at[0] * 1e3, at[1] * 1e3
    )]
    OutlineHoleOutside {
        /// The ring: n for the n-th hole.
        ring: usize,
        /// A point of it (m).
        at: [f64; 2],
    },

    /// There are more or fewer positions than grippers.
    #[error("there are {found} positions{}; the ply has {expected} grippers: give each of them one position", in_step(.step))]
    GripperCount {
        /// Counts from 1; `None` for positions that belong to no step.
        step: Option<usize>,
        /// Positions given.
        found: usize,
        /// Grippers of the ply.
        expected: usize,
    },
    /// A coordinate of a gripper is NaN, infinite or farther than any robot reaches.
    #[error("gripper {} is at {position:?} m{}: coordinates are finite numbers up to {most:e} m", gripper_name(*gripper), in_step(.step))]
    GripperFar {
        /// Counts from 1; `None` for positions that belong to no step.
        step: Option<usize>,
        /// The gripper.
        gripper: GripperId,
        /// Where it was put (m).
        position: [f64; 3],
        /// Largest coordinate (m).
        most: f64,
    },
    /// Neighboring grippers are (all but) straight above each other, or at one place.
    #[error(
        "grippers {} and {} are only {:.3} mm apart in plan{}; the ply between them is {:.2} mm: move them apart, because a span needs a horizontal distance of 1 % of its fabric or more",
        gripper_name(*a), gripper_name(*b), run * 1e3, in_step(.step), length * 1e3
    )]
    GripperSteep {
        /// Counts from 1; `None` for positions that belong to no step.
        step: Option<usize>,
        /// One gripper.
        a: GripperId,
        /// The other.
        b: GripperId,
        /// Their horizontal distance (m).
        run: f64,
        /// Fabric between them in the flat ply (m).
        length: f64,
    },
    /// Times and steps of positions do not go together, or there are none.
    #[error(
        "there are {times} times and {steps} steps of positions: give as many of both, at least one"
    )]
    StepCount {
        /// Times given.
        times: usize,
        /// Steps of positions given.
        steps: usize,
    },
    /// The time of a step is not finite, not 0 at the start, or less than [`crate::motion::SHORTEST_STEP`] after the one before.
    #[error("the time of step {step} is {time} s{}: times begin at 0 and rise by a microsecond at least", after(.before))]
    StepTime {
        /// Counts from 1.
        step: usize,
        /// Time (s).
        time: f64,
        /// Time of the step before (s).
        before: Option<f64>,
    },

    /// A net has no nodes in one direction.
    #[error("a net of {nu} × {nv} nodes has none: both counts must be at least 1")]
    NetNoNodes {
        /// Nodes along u.
        nu: usize,
        /// Nodes along v.
        nv: usize,
    },
    /// A mesh width of a net is no length.
    #[error("the mesh widths are {du} m and {dv} m: both must be positive")]
    NetMeshWidth {
        /// Along u (m).
        du: f64,
        /// Along v (m).
        dv: f64,
    },
    /// The seed of a net is not one of its nodes.
    #[error(
        "the seed node [{i}, {j}] is not one of the {nu} × {nv} nodes, which count from [0, 0]"
    )]
    NetSeedNode {
        /// Of the seed, along u.
        i: usize,
        /// Of the seed, along v.
        j: usize,
        /// Nodes along u.
        nu: usize,
        /// Nodes along v.
        nv: usize,
    },
    /// The seed of a net does not lie on the mold.
    #[error("the seed lies {distance_mm:.3} mm off the mold: give a point of the mold")]
    NetSeedPlace {
        /// How far off (mm).
        distance_mm: f64,
    },
    /// The mold is upright at the seed of a net.
    #[error(
        "the mold is upright at the seed, where a heading in plan leads nowhere along it: seed it elsewhere"
    )]
    NetUpright,
    /// The pre-shear of a net shuts its cells, or its heading is no angle.
    #[error(
        "pre-shear {shear_deg:.2}° and heading {heading_deg:.2}°: the pre-shear must be within ±89°"
    )]
    NetShear {
        /// Pre-shear (degrees).
        shear_deg: f64,
        /// Heading (degrees).
        heading_deg: f64,
    },
    /// A target boundary has fewer than three points.
    #[error("the target boundary has {points} different points: a closed line needs three or more")]
    BoundaryTooFew {
        /// How many.
        points: usize,
    },
    /// A point of a target boundary is not on the mold.
    #[error("point {} of the target boundary lies {:.3} mm off the mold", point + 1, distance * 1e3)]
    BoundaryOffMold {
        /// Which, counted from 0.
        point: usize,
        /// How far (m).
        distance: f64,
    },

    /// A motion has nothing to move.
    #[error("a motion needs at least one step with at least one gripper")]
    MotionEmpty,
    /// A step of a motion has another number of grippers than the first.
    #[error(
        "step {step} has {found} grippers and the first step {expected}: give every gripper a position in every step"
    )]
    MotionUnequal {
        /// Counts from 1.
        step: usize,
        /// Grippers in that step.
        found: usize,
        /// Grippers in the first step.
        expected: usize,
    },
    /// There are not as many positions as a motion has steps.
    #[error(
        "{found} lists of positions were given and the motion has {expected} steps: give one a step"
    )]
    MotionSteps {
        /// Lists given.
        found: usize,
        /// Steps of the motion.
        expected: usize,
    },
    /// A motion or its attitudes are of another grid.
    #[error("{found} grippers move and the grid has {expected}: give both the same grippers")]
    MotionGrippers {
        /// Grippers of the motion or the attitudes.
        found: usize,
        /// Grippers of the grid.
        expected: usize,
    },
    /// A coordinate of a motion is NaN, infinite or farther than any robot reaches.
    #[error(
        "gripper {gripper} in step {step} is at {position:?} m: coordinates are numbers up to {most:e} m"
    )]
    MotionFar {
        /// Counts from 1.
        step: usize,
        /// Index of the gripper.
        gripper: usize,
        /// Where it was put (m).
        position: [f64; 3],
        /// Largest coordinate (m).
        most: f64,
    },
    /// The frame of a tool jumps from one posture to another that follows the grippers alike.
    #[error(
        "the frame tips over in step {step}: it turns by {turn_deg:.1}° while no gripper moves farther than {moved_mm:.1} mm; give [tool] axes with longer strokes, or one more axis"
    )]
    ToolTips {
        /// Counts from 1.
        step: usize,
        /// Turn of the frame in that step (°).
        turn_deg: f64,
        /// Largest movement of a gripper in that step (mm).
        moved_mm: f64,
    },
    /// A limit of a motion is out of range.
    #[error("the limit of the {quantity} is {value}: give a number from {least:e} to {most:e}")]
    MotionLimit {
        /// `speed`, `acceleration` or `jerk`.
        quantity: &'static str,
        /// The value of the caller (SI).
        value: f64,
        /// Least value (SI).
        least: f64,
        /// Largest value (SI).
        most: f64,
    },
    /// The recorded time law of a motion does not fit its recorded path.
    #[error("the recorded time law does not belong to the recorded path: plan again")]
    MotionLaw,
    /// The rate at which a motion is sampled is no number above zero.
    #[error("{rate} samples a second: give a rate above 0 Hz")]
    MotionRate {
        /// The value of the caller (Hz).
        rate: f64,
    },
    /// The dense motion would be larger than a motion may be.
    #[error(
        "{rate} Hz over {duration:.3} s and {grippers} grippers are {samples:e} samples; {most} are the most: choose a rate below {largest_rate:.3e} Hz"
    )]
    MotionTooManySamples {
        /// The value of the caller (Hz).
        rate: f64,
        /// Duration of the motion (s).
        duration: f64,
        /// Number of grippers.
        grippers: usize,
        /// Samples that the rate asks for.
        samples: f64,
        /// Most samples.
        most: usize,
        /// Largest rate with that number (Hz).
        largest_rate: f64,
    },
    /// Times of attitudes are not one a step, or do not ascend.
    #[error("{steps} steps of attitudes at {times} times: give one finite time a step, ascending")]
    AttitudeTimes {
        /// Steps given.
        steps: usize,
        /// Times given.
        times: usize,
    },
    /// The quaternion of an attitude has no direction.
    #[error(
        "gripper {gripper} in step {step} has the quaternion {quaternion:?}: its length must be about 1"
    )]
    AttitudeQuaternion {
        /// Counts from 1.
        step: usize,
        /// Index of the gripper.
        gripper: usize,
        /// The value of the caller (x, y, z, w).
        quaternion: [f64; 4],
    },
}

impl Error {
    /// What to do about a mesh that is no mold; empty of other errors, whose text says it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Error::MeshEmpty { .. } => "export the mold as a surface mesh".into(),
            Error::MeshVertex { .. } => "number the vertices from 0".into(),
            Error::MeshNoArea { .. } => "check the coordinates".into(),
            Error::MeshSize { .. } => "state the unit that the file is written in".into(),
            Error::MeshScale { .. } => "give the meters of one unit of the file".into(),
            Error::MeshBranching { noun, .. } => {
                format!("a mold is one skin: two {noun}s at an edge, or one at its boundary")
            }
            Error::MeshOneSided { .. } => "cut it there".into(),
            Error::MeshSideways { .. } => {
                "turn the mold, or close its holes if it is meant to be a solid".into()
            }
            _ => String::new(),
        }
    }

    /// This fault of positions in a step, counted from 1.
    #[must_use]
    pub(crate) fn at_step(mut self, number: usize) -> Self {
        if let Error::GripperCount { step, .. }
        | Error::GripperFar { step, .. }
        | Error::GripperSteep { step, .. } = &mut self
        {
            *step = Some(number);
        }
        self
    }
}

/// Two triangles may come from one face.
fn pair(noun: &str, [a, b]: &[u64; 2]) -> String {
    if a == b { format!("{noun} {a}") } else { format!("{noun}s {a} and {b}") }
}

fn ring_name(ring: usize) -> String {
    if ring == 0 { "the boundary".into() } else { format!("hole {ring}") }
}

fn crossing(a: usize, b: usize) -> String {
    if a == b {
        format!("{} crosses or touches itself", ring_name(a))
    } else {
        format!("{} and {} cross or touch", ring_name(a), ring_name(b))
    }
}

fn in_step(step: &Option<usize>) -> String {
    step.map(|step| format!(" in step {step}")).unwrap_or_default()
}

fn after(before: &Option<f64>) -> String {
    before.map(|before| format!(", after {before} s in the step before")).unwrap_or_default()
}
