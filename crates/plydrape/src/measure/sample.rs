//! A layup and a state of its ply, for the tests of the measures.

use crate::geometry::Point;
use crate::layup::{Layup, Model, Settings, Target};
use crate::material::Material;
use crate::mold::{Mold, Plane};
use crate::motion::Motion;
use crate::ply::{Grid, Ply};
use crate::state::{CellState, FabricPoint, GripperState, LineState, PlyState, Site};

/// Four grippers on a square of 100 mm over a flat mold at z = 0, which are to come down by 50 mm in 2 s.
pub fn layup() -> Layup {
    let woven = Material::woven("", 0.3, 9e-5, 1e6, 5.0);
    let material = Material { shear_curve: None, tension: None, ..woven };
    let ply = Ply::of_array(Grid { nu: 2, nv: 2 }, [0.1; 2], material);
    let positions = vec![corners(0.05), corners(0.0)];
    let mut layup =
        Layup::new(ply, Settings::default(), Motion { times: vec![0.0, 2.0], positions });
    layup.mold = Some(Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] }));
    layup.target = Some(Target { grippers: corners(0.0), drape: None });
    layup
}

/// Places of the grippers at a height (m).
fn corners(height: f64) -> Vec<Point> {
    [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]].map(|[x, y]| [x, y, height]).to_vec()
}

/// The ply as catenaries at the start: every gripper has a load of 6 N, a pull of 5 N and a tilt of 0.1; the only edge has 40 mm on the mold,
/// one free segment of 60 mm that is 0.3 mm too long and one of 100 mm that is 0.2 mm too short; one point has landed 1 mm off its place and 0.1 mm
/// below the mold, another hangs 20 mm over it; the cell is sheared by 0.2.
pub fn state(layup: &Layup) -> PlyState {
    // 3 N and 4 N make a pull of 5 N, beside a load of 6 N
    let gripper = |position: &Point| GripperState {
        position: *position,
        commanded: *position,
        quaternion: [0.0, 0.0, 0.0, 1.0],
        tilt: 0.1,
        force: [3.0, 4.0, -6.0],
        slide: 0.0,
        holds: true,
    };
    // a segment of the one line, of 200 mm in all, with no shape of its own
    let line = |catenary: usize, length: f64, path: f64| LineState {
        site: Site::Catenary(catenary),
        catenary: Some(catenary),
        is_fiber: layup.ply.lines().catenary(catenary).kind.is_edge(),
        place: [0.05, 0.0, 0.0],
        length,
        whole: 0.2,
        path,
        force: None,
        hangs: false,
        lies: false,
        sag: None,
        slope: None,
        bridge: None,
        fiber_angle: None,
    };
    // a point that is not above the mold has landed, 1 mm off its place
    let point = |height: f64| FabricPoint {
        site: Site::Fabric([0.05; 2]),
        place: [0.05, 0.05, height],
        normal: None,
        height: Some(height),
        lies: height <= 0.0,
        area: 0.0,
        error: (height <= 0.0).then_some(1e-3),
    };
    let cell = CellState {
        site: Site::Cell(0),
        place: [0.05, 0.05, 0.01],
        shear: 0.2,
        directions: None,
        landing_error: None,
    };
    PlyState {
        model: Model::Catenaries,
        step: 1,
        time: 0.0,
        points: vec![point(-1e-4), point(0.02)],
        // a slack segment, one on the mold, and one that is overstretched
        lines: vec![
            line(0, 0.06, 0.0597),
            LineState { lies: true, ..line(0, 0.04, 0.04) },
            line(0, 0.1, 0.1002),
        ],
        cells: vec![cell],
        grippers: layup.motion.positions[0].iter().map(gripper).collect(),
        unsolved: None,
    }
}
