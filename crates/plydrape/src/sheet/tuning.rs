//! Every tolerance and constant of the sheet's solver, dimensionless or scaled by the problem.

/// Tolerances and constants of the sheet's solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetTuning {
    /// Depth (of the pitch of the grippers) that the ply's own weight sinks into the contact's penalty: small enough that
    /// the pressure of taut yarns on a mold, some hundred times the weight, stays below 0.02 mm of 100 mm.
    pub contact_depth: f64,
    /// Stiffness of contact under a pad whose mount gives along its axis, as a multiple of that of the mount: so a pad sinks in by
    /// a hundredth of what its mount yields.
    pub mount_contact: f64,
    /// Way along the mold (of the pitch) in which Coulomb's friction under the ply's own weight builds up: as long as a step
    /// tolerance, because Newton's iteration cannot see shorter ways; 0.01 mm of 100 mm. Stick has no such bound and is as
    /// stiff as contact.
    pub slip: f64,
    /// Height (of the pitch) at which a point that stuck is free again; 0.05 mm of 100 mm, as in the reference figures.
    pub release: f64,
    /// Kinetic energy that a quasi-static motion may have, as a height (of the pitch) by which it would lift the ply:
    /// 0.05 mm of 100 mm.
    pub lift: f64,
    /// Largest step of Newton's iteration at which a time step is solved (of the mesh).
    pub step_tolerance: f64,
    /// Largest step of Newton's iteration at which the drape ends (of the mesh).
    pub rest_tolerance: f64,
    /// Factor of safety on the size of the next step of the iteration, which is predicted to go with the square of the last one. The
    /// iteration ends where that prediction, made larger by this factor, is below the tolerance.
    pub next_step: f64,
    /// Iterations after which a time step in which the ply buckles, so that its matrix is not positive definite, may end with a
    /// larger last step, see `creep`.
    pub creep_iterations: usize,
    /// Multiple of the tolerance that the last step of the iteration may have in a time step in which the ply buckles.
    pub creep: f64,
    /// Largest turn of a segment in one step of the iteration (rad): a linear step of an inextensible line is wrong by the
    /// square of it.
    pub turn: f64,
    /// Turn (of the largest one) to which a time step is shortened whose first step of the iteration turns a segment farther.
    pub turn_margin: f64,
    /// Least share of a time step that is tried next, where its first step of the iteration turns a segment too far.
    pub turn_retry: f64,
    /// Most iterations of a time step; one that needs more is halved.
    pub iterations: usize,
    /// Iterations of full steps; in those that follow, half of each step in which contact or slip switched is taken, which
    /// ends cycles of contact.
    pub full_iterations: usize,
    /// Iterations up to which a time step was easy, and is followed by one that is twice as long.
    pub easy_iterations: usize,
    /// Way (of the pitch) that a node may go in the time step in which it comes to the mold: it is held where it is at the
    /// end of this step. A time step is no longer than that in which every free node goes this way or its distance from the
    /// mold, the larger of the two.
    pub contact_way: f64,
    /// Largest movement in a time step (of the mesh) of a node that lies on the mold.
    pub lying_movement: f64,
    /// Time steps for which a node has moved no more than `lying_movement`, before it is left out of the linear systems.
    pub lying_steps: u32,
    /// Largest force (of the weight of a node) that is out of balance at a node that is left out where the mold does not press it.
    pub lying_force: f64,
    /// Rings of nodes around one that moves beyond the tolerance in a linear step, which stay unknowns with it: two, because a
    /// second difference reaches as far.
    pub moving_rings: usize,
    /// Longest time step of a motion in its own time, as a share of √(pitch/g), the time of a swing: implicit steps damp
    /// what is faster.
    pub real_step: f64,
    /// Share of a motion's step from which on a time step that is not solved is not shortened any more: the drape is given up.
    pub smallest_step: f64,
    /// Most time steps that are tried in a step of the motion.
    pub tries: usize,
    /// Most time steps of the relaxation at the end.
    pub rest_steps: usize,
    /// Largest movement in a time step (of the mesh) at which the ply is at rest.
    pub rest_movement: f64,
    /// Relaxation times of the resin that the last time step of the relaxation takes at least.
    pub relaxed: f64,
    /// Stiffness that holds a pad within its tilt limit, as a multiple of the weight of a pitch by a pitch times the pitch,
    /// per radian.
    pub tilt_stiffness: f64,
    /// Stiffness against the turn of any pad, in the unit of `tilt_stiffness`, so small that it acts only where nothing else does.
    pub turn_stiffness: f64,
}

impl Default for SheetTuning {
    fn default() -> Self {
        SheetTuning {
            contact_depth: 1e-7,
            mount_contact: 100.0,
            slip: 1e-4,
            release: 5e-4,
            lift: 5e-4,
            step_tolerance: 1e-3,
            rest_tolerance: 1e-4,
            next_step: 30.0,
            creep_iterations: 8,
            creep: 10.0,
            turn: 0.3,
            turn_margin: 0.8,
            turn_retry: 0.05,
            iterations: 20,
            full_iterations: 8,
            easy_iterations: 6,
            contact_way: 0.01,
            lying_movement: 1e-4,
            lying_steps: 2,
            lying_force: 0.1,
            moving_rings: 2,
            real_step: 0.02,
            smallest_step: 1e-4,
            tries: 400,
            rest_steps: 100,
            rest_movement: 1e-4,
            relaxed: 10.0,
            tilt_stiffness: 1e3,
            turn_stiffness: 1e-6,
        }
    }
}
