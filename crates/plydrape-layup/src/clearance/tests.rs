//! Distances against closed forms, and the bound that no sampling misses.

use super::moves::{Legs, Moves, Origin, Planned, Straight};
use super::nearest::along;
use super::over_mold::OverMold;
use super::*;
use crate::bodies::{Bodies, Body, Mount, Obstacle, Shape, Solid, Surface};
use crate::geometry::vector::norm;
use crate::layup::{Layup, Settings};
use crate::mold::{
    Cylinder, Face, Graph, HeightGrid, Mold, Plane, Pose, Saddle, Sphere, Surface as Height, Torus,
    distance,
};
use crate::motion::{Attitudes, Bounds, Motion, TimedMotion};
use crate::ply::{Grid, cloth};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_4, SQRT_2};

/// The limit of clearances that are resolved (m).
const LIMIT: f64 = 5e-3;

/// A layup of this many grippers, without a mold.
fn layup(grid: Grid, bodies: Vec<Body>, obstacles: Vec<Obstacle>) -> Layup {
    let (ply, settings) = (cloth(grid), Settings::default());
    let place = |n: usize| {
        let [i, j] = grid.id(n).map(|k| 0.1 * k as f64);
        [i, j, 0.2]
    };
    let positions = vec![(0..grid.grippers()).map(place).collect()];
    let motion = Motion { times: vec![0.0], positions };
    Layup { bodies: Bodies::new(bodies, obstacles), ..Layup::new(ply, settings, motion) }
}

fn body(name: &str, on: Mount, shape: Shape) -> Body {
    Body { name: name.into(), on, shape }
}

/// Grippers whose pads and stems are turned alike.
fn free_of(pads: &[Pose]) -> Poses {
    Poses { pads: pads.to_vec(), stems: pads.to_vec(), flange: None, links: Vec::new() }
}

fn cylinder(radius: f64, from: f64, to: f64) -> Shape {
    Shape::Cylinder { radius, from, to }
}

fn cube(side: f64) -> Shape {
    Shape::Box { size: [side; 3], at: [0.0; 3] }
}

/// The surface of a cube as triangles.
fn cube_of_triangles(side: f64) -> Shape {
    let h = 0.5 * side;
    let corner = |n: usize| [0, 1, 2].map(|c| if n >> c & 1 == 1 { h } else { -h });
    let faces: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    Shape::Mesh { vertices: (0..8).map(corner).collect(), triangles: triangles.collect() }
}

fn apart(a: &Shape, own: Pose, b: &Shape, its: Pose) -> f64 {
    Solid::new(a).apart(&own, &Solid::new(b), &its).distance
}

fn posed(position: [f64; 3], rotation: [f64; 3]) -> Pose {
    Pose::new(position, rotation)
}

fn over(mold: &Mold, shape: &Shape, pose: Pose, resolution: f64) -> f64 {
    let bodies = Bodies::new(Vec::new(), Vec::new());
    let over = OverMold::new(mold, bodies.made());
    over.apart(&Solid::new(shape), &Surface::new(shape), &pose, resolution).distance
}

/// A foil of a picometer, of which no hull can be made, and corners without triangles keep things off as the solid bodies around them do.
#[test]
fn a_body_without_a_hull_is_where_it_stands() {
    let foil = Shape::Box { size: [1.0, 1.0, 1e-12], at: [2.0, 0.0, 0.0] };
    let found = apart(&foil, Pose::ORIGIN, &cube(0.02), posed([2.2, 0.1, 0.1], [0.0; 3]));
    assert!((found - 0.09).abs() < 1e-9, "{found}");
    let vertices = vec![[2.0, 0.0, -0.1], [2.0, 0.0, 0.1]];
    let corners = Shape::Mesh { vertices, triangles: Vec::new() };
    let found = apart(&corners, Pose::ORIGIN, &cube(0.02), posed([2.2, 0.0, 0.0], [0.0; 3]));
    assert!((found - 0.09).abs() < 1e-9, "{found}");
}

/// Face to face, a vertical edge to a face, and a depth: cubes of 20 mm that are turned about z by 45° reach 10√2 mm along x.
#[test]
fn turned_boxes_are_as_far_apart_as_their_edges() {
    let a = cube(0.02);
    let still = posed([0.0; 3], [0.0; 3]);
    for b in [cube(0.02), cube_of_triangles(0.02)] {
        let near = |x: f64, turn: f64, wanted: f64| {
            let found = apart(&a, still, &b, posed([x, 0.003, 0.001], [0.0, 0.0, turn]));
            assert!((found - wanted).abs() < 1e-12, "{x} {turn}: {found} {wanted}");
        };
        near(0.05, 0.0, 0.03);
        near(0.05, FRAC_PI_4, 0.04 - 0.01 * SQRT_2);
    }
    // edges at right angles, both along the line between the middles
    let b = posed([0.05, 0.0, 0.0], [FRAC_PI_4, 0.0, 0.0]);
    let b = Pose { axes: [b.axes[1], b.axes[0].map(|x| -x), b.axes[2]], ..b };
    let own = posed([0.0; 3], [0.0, 0.0, FRAC_PI_4]);
    let found = apart(&a, own, &cube(0.02), b);
    assert!(found > 0.05 - 0.02 * SQRT_2 - 1e-12 && found < 0.04, "{found}");
    let deep = apart(&a, still, &cube(0.02), posed([0.0, 0.0, 0.015], [0.0; 3]));
    assert!((deep + 0.005).abs() < 1e-9, "{deep}");
}

/// Parallel cylinders are d − 2r apart, crossed ones too; one end over another as far as their heights say.
#[test]
fn cylinders_are_as_far_apart_as_their_axes_less_their_radii() {
    let a = cylinder(0.01, 0.0, 0.1);
    let still = posed([0.0; 3], [0.0; 3]);
    let beside = apart(&a, still, &a, posed([0.03, 0.04, 0.02], [0.0; 3]));
    assert!((beside - 0.03).abs() < 1e-9, "{beside}");
    let crossed = apart(&a, still, &a, posed([-0.05, 0.04, 0.05], [0.0, 2.0 * FRAC_PI_4, 0.0]));
    // the search ends where it gains less than 5e-8 of the distance
    assert!((crossed - 0.02).abs() < 1e-8, "{crossed}");
    let above = apart(&a, still, &a, posed([0.0, 0.0, 0.13], [0.0; 3]));
    assert!((above - 0.03).abs() < 1e-9, "{above}");
}

/// What a closed mesh encloses does not touch its surface, and is inside all the same.
#[test]
fn a_body_inside_a_closed_mesh_is_not_clear_of_it() {
    let (small, large) = (cube(0.02), cube_of_triangles(0.2));
    let still = posed([0.0; 3], [0.0; 3]);
    for [a, b] in [[&small, &large], [&large, &small]] {
        let found = apart(a, still, b, still);
        assert!((found + 0.09).abs() < 1e-9, "{found}");
    }
}

/// An upright cylinder over a sphere: its end is as far as it is high over the top, beside the top its boundary is nearest.
#[test]
fn a_cylinder_is_as_far_from_a_sphere_as_the_nearest_point_of_its_boundary() {
    let pose = Pose::upright([0.0, 0.0, -0.5]);
    let mold = Mold::Sphere(Sphere { pose, radius: 0.5, face: Face::Outside });
    let shape = cylinder(0.02, 0.03, 0.1);
    let resolution = 1e-6;
    for (x, wanted) in [
        (0.0, 0.03),
        (0.01, 0.03),
        (0.1, 0.08_f64.hypot(0.53) - 0.5),
        (-0.3, 0.28_f64.hypot(0.53) - 0.5),
    ] {
        let found = over(&mold, &shape, Pose::upright([x, 0.0, 0.0]), resolution);
        assert!((found - wanted).abs() <= resolution, "{x}: {found} {wanted}");
    }
}

/// A box over an inclined plane, turned: its nearest corner counts; so does its deepest one in the mold.
#[test]
fn a_box_is_as_far_from_a_plane_as_its_nearest_corner() {
    let normal = [0.6, 0.0, 0.8];
    let mold = Mold::Plane(Plane { point: [0.0; 3], normal });
    let sides = [0.03, 0.05, 0.08];
    let shape = Shape::Box { size: sides, at: [0.01, 0.0, 0.02] };
    for height in [0.2, 0.03, 0.0] {
        let pose = posed([0.1, 0.02, height], [0.4, -1.1, 2.2]);
        let corner = |n: usize| {
            let side = |c: usize| if n >> c & 1 == 1 { 0.5 } else { -0.5 } * sides[c];
            mold.signed_distance(pose.place([0.01 + side(0), side(1), 0.02 + side(2)]))
        };
        let wanted = (0..8).map(corner).fold(f64::INFINITY, f64::min);
        let found = over(&mold, &shape, pose, 1e-7);
        assert!((found - wanted).abs() <= 1e-7, "{height}: {found} {wanted}");
    }
}

/// A stem between two waves of a grid of heights is near their crests, not the trough below it; brute force says how near.
#[test]
fn a_stem_in_a_trough_is_near_its_walls() {
    let nodes: Vec<f64> = (0..=100).map(|k| 0.01 * f64::from(k) - 0.5).collect();
    let across: Vec<f64> = (0..5).map(|k| 0.25 * f64::from(k) - 0.5).collect();
    let wave = |x: &f64| -0.05 * (x / 0.3 * std::f64::consts::TAU).cos();
    let z = across.iter().flat_map(|_| nodes.iter().map(wave)).collect();
    let grid = HeightGrid::new(nodes, across, z).unwrap();
    let domain = Some([[-0.5, 0.5], [-0.5, 0.5]]);
    let surface = Height::HeightGrid(grid);
    let graph = Graph { pose: Pose::upright([0.0; 3]), surface, domain };
    let mold = Mold::Graph(graph);
    let shape = cylinder(0.03, 0.0, 0.2);
    let pose = Pose::upright([0.07, 0.0, -0.02]);
    let found = over(&mold, &shape, pose, 1e-6);
    let mut wanted = f64::INFINITY;
    for a in 0..720 {
        let (sin, cos) = (f64::from(a) * std::f64::consts::TAU / 720.0).sin_cos();
        for k in 0..=400 {
            let p = pose.place([0.03 * cos, 0.03 * sin, 0.2 * f64::from(k) / 400.0]);
            wanted = wanted.min(mold.signed_distance(p));
        }
    }
    assert!(found <= wanted + 1e-6 && found > wanted - 1e-4, "{found} {wanted}");
}

/// A trough, a bowl, the hole of a ring, a ring-shaped channel and a saddle: a cylinder and a box anywhere over them, level or
/// not, against points of their surfaces.
#[test]
fn bodies_over_hollow_molds_are_as_far_as_their_nearest_points() {
    let still = Pose::upright([0.0; 3]);
    let at_bottom = |radius: f64| Pose::upright([0.0, 0.0, radius]);
    let saddle = Height::Saddle(Saddle { radii: [0.4, 0.3] });
    let domain = Some([[-0.5, 0.5], [-0.5, 0.5]]);
    let molds = [
        Mold::Cylinder(Cylinder { pose: at_bottom(0.3), radius: 0.3, face: Face::Inside }),
        Mold::Sphere(Sphere { pose: at_bottom(0.25), radius: 0.25, face: Face::Inside }),
        Mold::Torus(Torus { pose: still, ring_radius: 0.3, tube_radius: 0.1, face: Face::Outside }),
        Mold::Torus(Torus {
            pose: posed([0.2, 0.0, 0.1], [0.0; 3]),
            ring_radius: 0.2,
            tube_radius: 0.1,
            face: Face::Inside,
        }),
        Mold::Graph(Graph { pose: still, surface: saddle, domain }),
    ];
    let bodies = [cylinder(0.02, 0.0, 0.05), Shape::Box { size: [0.06, 0.04, 0.02], at: [0.0; 3] }];
    for (k, mold) in molds.iter().enumerate() {
        for shape in &bodies {
            for (n, height) in [0.01, 0.05, 0.12, 0.2].into_iter().enumerate() {
                for tilt in [0.0, 0.3] {
                    let x = 0.03 * n as f64;
                    let pose = posed([x, 0.02, height], [tilt, 0.5 * tilt, 0.0]);
                    let found = over(mold, shape, pose, 1e-5);
                    let near =
                        points(shape).into_iter().map(|p| mold.signed_distance(pose.place(p)));
                    let near = near.fold(f64::INFINITY, f64::min);
                    // far away points are a twentieth of their distance apart
                    let coarse = 1e-5 + 0.06 * near.abs();
                    assert!(
                        found <= near + coarse && found >= near - 1.6e-3,
                        "{k} {n} {tilt}: {found} {near}"
                    );
                }
            }
        }
    }
}

/// A large box level over a plane and over a mesh of two triangles, in the air and beneath: as far as its bottom.
#[test]
fn a_level_box_is_as_far_as_its_bottom() {
    let corners = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let (mesh, _) = crate::mold::Mesh::of_triangles(corners, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    let plane = Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let box_ = Shape::Box { size: [1.0, 0.8, 0.1], at: [0.0; 3] };
    for mold in [Mold::Plane(plane), Mold::Mesh(std::sync::Arc::new(mesh))] {
        let found = over(&mold, &box_, Pose::upright([0.1, 0.0, 0.25]), 1e-6);
        assert!((found - 0.2).abs() < 1e-6, "{found}");
        let found = over(&mold, &box_, Pose::upright([0.1, 0.0, 0.03]), 1e-6);
        assert!((found + 0.02).abs() < 1e-6, "{found}");
        let found = over(&mold, &box_, Pose::upright([0.1, 0.0, -0.3]), 1e-6);
        assert!((found + 0.35).abs() < 1e-6, "{found}");
    }
}

fn quaternion() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("a turn", |q| q.iter().map(|c| c * c).sum::<f64>() > 0.01)
        .prop_map(|q| {
            let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
            q.map(|c| c / length)
        })
}

fn pose(wide: f64) -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-wide..wide), quaternion()).prop_map(|(p, q)| Pose::of_quaternion(p, q))
}

fn shapes() -> [Shape; 3] {
    [
        cylinder(0.015, 0.01, 0.06),
        Shape::Box { size: [0.03, 0.05, 0.02], at: [0.01, 0.0, 0.02] },
        cube_of_triangles(0.03),
    ]
}

/// Points of a shape's surface, nowhere farther than 1.5 mm from the next.
fn points(shape: &Shape) -> Vec<[f64; 3]> {
    let surface = Surface::new(shape);
    let (mut out, mut parts) = (Vec::new(), surface.patches.clone());
    while let Some(part) = parts.pop() {
        let (middle, reach, belongs) = surface.ball(&part);
        match belongs && reach < 1.5e-3 {
            true => out.push(middle),
            false => parts.extend(surface.halves(&part)),
        }
    }
    out
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    /// Against all points of both surfaces: no two are nearer than the distance, and two are nearer than it and the points' pitch.
    #[test]
    fn no_two_points_are_nearer_than_the_distance(
        a in 0..3_usize, b in 0..3_usize, own in pose(0.06), its in pose(0.06),
    ) {
        let (a, b) = (&shapes()[a], &shapes()[b]);
        let found = apart(a, own, b, its);
        let [p, q] = [(a, own), (b, its)].map(|(shape, pose)| {
            points(shape).into_iter().map(|p| pose.place(p)).collect::<Vec<_>>()
        });
        let nearest = p.iter().flat_map(|p| q.iter().map(|q| distance(*p, *q)));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        if found > 0.0 {
            prop_assert!(nearest >= found - 1e-9 && nearest <= found + 3e-3, "{} {}", found, nearest);
        }
        // both ways alike, and alike in a scaled copy
        let back = apart(b, its, a, own);
        prop_assert!((back - found).abs() < 1e-7, "{} {}", back, found);
    }

    /// Bodies that go straight and turn, past an obstacle and each other: no sample of a fine sampling is nearer than is reported
    /// by more than the resolution.
    #[test]
    fn no_sample_is_nearer_than_is_reported(
        ends in prop::collection::vec(pose(0.15), 4), place in pose(0.1),
    ) {
        let bodies = vec![body("cup", Mount::Pad, cylinder(0.015, 0.0, 0.06))];
        let obstacle = Obstacle { name: "clamp".into(), pose: place, shape: cube(0.04) };
        let layup = layup(Grid { nu: 2, nv: 1 }, bodies, vec![obstacle]);
        let poses = |n: usize| Poses {
            pads: ends[2 * n..2 * n + 2].to_vec(),
            stems: ends[2 * n..2 * n + 2].to_vec(),
            flange: None,
            links: Vec::new(),
        };
        let (from, to) = (poses(0), poses(1));
        let found = super::between_steps(&layup, LIMIT, &from, &to).unwrap();
        let straight = Straight::new(&from, &to);
        let mut least = f64::INFINITY;
        for k in 0..=2000 {
            let time = f64::from(k) / 2000.0;
            let pads: Vec<Pose> = (0..2).map(|n| straight.pose(Origin::Pad(n), time)).collect();
            let now = Poses { stems: pads.clone(), pads, flange: None, links: Vec::new() };
            least = least.min(super::at_poses(&layup, LIMIT, &now).unwrap().distance);
        }
        let resolution = 0.011 * found.distance.abs().max(LIMIT);
        if found.distance > 0.0 {
            prop_assert!(least >= found.distance - resolution, "{} {}", least, found.distance);
            prop_assert!(found.distance >= least - 1e-4, "{} {}", least, found.distance);
        } else {
            prop_assert!(least <= 2e-3, "{} {}", least, found.distance);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The distance of two bodies that go straight and turn changes by no more than its bound, between any two times.
    #[test]
    fn the_change_of_a_distance_is_bounded(ends in prop::collection::vec(pose(0.3), 4)) {
        let poses = |n: usize| free_of(&ends[2 * n..2 * n + 2]);
        let straight = Straight::new(&poses(0), &poses(1));
        let shapes = [cylinder(0.01, -0.02, 0.03), cube(0.03)];
        let reach = |shape: &Shape| norm(shape.ball().0) + shape.ball().1;
        let distance = |time: f64| {
            let [a, b] = [0, 1].map(|n| straight.pose(Origin::Pad(n), time));
            apart(&shapes[0], a, &shapes[1], b)
        };
        let [one, other] = [0, 1].map(|n| (Origin::Pad(n), reach(&shapes[n])));
        let times: Vec<f64> = (0..=20).map(|k| f64::from(k) / 20.0).collect();
        let found: Vec<f64> = times.iter().map(|time| distance(*time)).collect();
        for a in 0..times.len() {
            for b in a + 1..times.len() {
                let most = straight.change(one, Some(other), [times[a], times[b]]);
                let change = (found[a] - found[b]).abs();
                // depths and distances are found by two searches
                if found[a] > 0.0 && found[b] > 0.0 {
                    prop_assert!(change <= most + 1e-6, "{} {change} {most}", times[a]);
                }
            }
        }
    }
}

/// Bodies that one tool turns and carries do not come nearer to each other, however far it goes: what is left is the square of the turn, by which straight ways leave the circles.
#[test]
fn what_turns_alike_does_not_come_nearer() {
    let frame = |turn: f64, x: f64| posed([x, 0.2, 0.1], [0.0, 0.0, turn]);
    let both = |frame: Pose| {
        let place = |y: f64| Pose { position: frame.place([0.1, y, 0.0]), ..frame };
        free_of(&[place(-0.05), place(0.05)])
    };
    let turn = 0.004;
    let straight = Straight::new(&both(frame(0.0, 0.0)), &both(frame(turn, 0.3)));
    let [one, other] = [0, 1].map(|n| (Origin::Pad(n), 0.1));
    let most = straight.change(one, Some(other), [0.0, 1.0]);
    assert!(most <= 0.1 * turn * turn, "{most}");
    assert!(straight.change(one, None, [0.0, 1.0]) >= 0.3);
}

/// A planned motion of two grippers around each other, whose pads turn.
fn motion() -> (TimedMotion, Attitudes) {
    let rows: Vec<Vec<[f64; 3]>> = (0..9)
        .map(|k| f64::from(k) * 0.6)
        .map(|x| {
            vec![[0.3 * x.cos(), 0.3 * x.sin(), 0.1 * x], [0.0, 0.1 * x, 0.2 * (2.0 * x).sin()]]
        })
        .collect();
    let motion =
        TimedMotion::new(&rows, &Bounds { speed: 0.3, acceleration: 1.0, jerk: 10.0 }).unwrap();
    let turned = |k: usize| {
        let pose = Pose::new([0.0; 3], [0.2 * k as f64, 0.1, -0.3 * k as f64]);
        vec![pose.quaternion(), Pose::upright([0.0; 3]).quaternion()]
    };
    let turned: Vec<_> = (0..motion.times().len()).map(turned).collect();
    let attitudes = Attitudes::new(motion.times(), &turned).unwrap();
    (motion, attitudes)
}

/// Ways and turns of a planned motion bound what a fine sampling adds up to, and by not much more.
#[test]
fn ways_and_turns_of_a_motion_are_bounds() {
    let (motion, attitudes) = motion();
    let moves = Planned { motion: &motion, attitudes: &attitudes };
    let steps = motion.times();
    for pair in steps.windows(2) {
        let time = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / 200.0;
        let (mut own, mut seen, mut turned) = (0.0, 0.0, 0.0);
        for k in 0..200 {
            let [a, b] = [time(k), time(k + 1)];
            let [p, q] = [a, b].map(|t| [0, 1].map(|n| moves.pose(Origin::Pad(n), t)));
            let step = [0, 1].map(|n| [0, 1, 2].map(|c| q[n].position[c] - p[n].position[c]));
            own += norm(step[0]);
            seen += norm([0, 1, 2].map(|c| step[0][c] - step[1][c]));
            let turn = crate::motion::turn(&p[0].quaternion(), &q[0].quaternion());
            // a quaternion and its negative turn alike
            turned += turn.min(std::f64::consts::TAU - turn);
        }
        let times = [pair[0], pair[1]];
        let bound = |other| moves.travel(Origin::Pad(0), other, times);
        assert!(own <= bound(None) * (1.0 + 1e-9) && bound(None) < 1.3 * own + 1e-6);
        assert!(seen <= bound(Some(Origin::Pad(1))) * (1.0 + 1e-9));
        let turn = moves.turn(Origin::Pad(0), times);
        assert!((turned - turn).abs() < 1e-6, "{turned} {turn}");
    }
}

/// A body that passes through a thin wall between two steps is nowhere near it at the steps.
#[test]
fn a_wall_between_two_steps_is_met() {
    let bodies = vec![body("cup", Mount::Pad, cylinder(0.01, 0.0, 0.05))];
    let shape = Shape::Box { size: [0.001, 1.0, 1.0], at: [0.0; 3] };
    let wall = Obstacle { name: "wall".into(), pose: Pose::upright([0.5, 0.0, 0.2]), shape };
    let layup = layup(Grid { nu: 2, nv: 1 }, bodies, vec![wall]);
    let level = [[0.0, 0.0, 0.0, 1.0]; 2];
    let poses = |x: f64| {
        let places = [[x, 0.0, 0.1], [x + 0.1, 0.0, 0.1]];
        Poses::free(&places, &level, &places)
    };
    let (from, to) = (poses(0.0), poses(1.0));
    let ends = [&from, &to].map(|poses| super::at_poses(&layup, LIMIT, poses).unwrap().distance);
    assert!(ends.iter().all(|distance| *distance > 0.07), "{ends:?}");
    let found = super::between_steps(&layup, LIMIT, &from, &to).unwrap();
    assert!(found.distance <= 0.0, "{found:?}");
    assert_eq!(found.near, Near::Obstacle(0));
    assert!((found.place[0] - 0.5).abs() < 0.02, "{found:?}");
    assert_eq!(found.label(&layup).split(" of ").next(), Some("cup"));
    assert!(found.label(&layup).ends_with("and obstacle wall"), "{}", found.label(&layup));
}

/// Pads are not judged against the mold, stems are; bodies of one gripper are not judged against each other, those of two are.
#[test]
fn what_belongs_together_is_not_judged() {
    let pad = || body("cup", Mount::Pad, cylinder(0.015, 0.0, 0.03));
    let stem = || body("stem", Mount::Stem, cylinder(0.005, 0.02, 0.2));
    let grid = Grid { nu: 2, nv: 1 };
    let places = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]];
    let poses = Poses::free(&places, &[[0.0, 0.0, 0.0, 1.0]; 2], &places);
    let near = |bodies: Vec<Body>, with_mold: bool| {
        let mut layup = layup(grid, bodies, Vec::new());
        let plane = Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
        layup.mold = with_mold.then_some(Mold::Plane(plane));
        super::at_poses(&layup, LIMIT, &poses)
    };
    assert!((near(vec![pad(), stem()], false).unwrap().distance - 0.07).abs() < 1e-9);
    assert!((near(vec![pad()], true).unwrap().distance - 0.07).abs() < 1e-9);
    let over = near(vec![pad(), stem()], true).unwrap();
    assert!((over.distance - 0.02).abs() < 2e-4 && over.near == Near::Mold, "{over:?}");
    assert!(near(Vec::new(), true).is_none());
    // a flange that nobody carries meets nothing
    assert!(near(vec![body("frame", Mount::Flange, cube(0.1))], true).is_none());
}

/// A body of the flange is judged against mold and obstacles, not against the grippers that it carries.
#[test]
fn a_flange_is_judged_against_what_stands() {
    let bodies = vec![
        body("frame", Mount::Flange, cube(0.1)),
        body("stem", Mount::Stem, cylinder(0.005, 0.0, 0.2)),
    ];
    let pose = Pose::upright([0.5, 0.0, 0.25]);
    let clamp = Obstacle { name: "clamp".into(), pose, shape: cube(0.1) };
    let layup = layup(Grid { nu: 2, nv: 1 }, bodies, vec![clamp]);
    let places = [[0.0, 0.0, 0.1], [0.1, 0.0, 0.1]];
    let mut poses = Poses::free(&places, &[[0.0, 0.0, 0.0, 1.0]; 2], &places);
    poses.flange = Some(Pose::upright([0.05, 0.0, 0.25]));
    let found = super::at_poses(&layup, LIMIT, &poses).unwrap();
    assert!((found.distance - 0.09).abs() < 1e-9, "{found:?}");
    poses.flange = Some(Pose::upright([0.37, 0.0, 0.25]));
    let found = super::at_poses(&layup, LIMIT, &poses).unwrap();
    assert!((found.distance - 0.03).abs() < 1e-9, "{found:?}");
    assert_eq!((found.part, found.near), (Part { body: 0, gripper: None }, Near::Obstacle(0)));
}

/// A layup that is a thousand times as large, its limit too, has distances a thousand times as large, at the same time.
#[test]
fn a_scaled_cell_has_scaled_clearances() {
    let clearances = |scale: f64| {
        let bodies = vec![
            body("cup", Mount::Pad, cylinder(0.01 * scale, 0.0, 0.05 * scale)),
            body("stem", Mount::Stem, cylinder(0.004 * scale, 0.05 * scale, 0.2 * scale)),
        ];
        let pose = Pose::new([0.2, 0.03, 0.1].map(|c| scale * c), [0.3, 0.2, 0.1]);
        let shape = cube(0.04 * scale);
        let clamp = Obstacle { name: "clamp".into(), pose, shape };
        let mut layup = layup(Grid { nu: 2, nv: 1 }, bodies, vec![clamp]);
        let plane = Plane { point: [0.0, 0.0, -0.02 * scale], normal: [0.0, 0.0, 1.0] };
        layup.mold = Some(Mold::Plane(plane));
        let step = |x: f64| {
            vec![[x, 0.0, 0.2], [x + 0.1, 0.01, 0.2]]
                .into_iter()
                .map(|p: [f64; 3]| p.map(|c| scale * c))
                .collect::<Vec<_>>()
        };
        let neighbors = layup.ply.neighbors();
        let poses = [step(0.0), step(0.2), step(0.5)]
            .map(|step| Poses::by_neighbors(&layup, &neighbors, &step));
        let legs = poses.windows(2).map(|pair| Straight::new(&pair[0], &pair[1])).collect();
        along(&layup, LIMIT * scale, &Legs(legs), &[0.0, 1.0, 2.0], f64::INFINITY).unwrap()
    };
    let (one, thousand) = (clearances(1.0), clearances(1e3));
    assert!((thousand.distance / one.distance - 1e3).abs() < 1e-3, "{one:?} {thousand:?}");
    assert!((thousand.time - one.time).abs() < 1e-6);
    assert_eq!((thousand.part, thousand.near), (one.part, one.near));
}

/// The nearest pair of a planned motion, against a fine sampling of it.
#[test]
fn no_sample_of_a_planned_motion_is_nearer_than_is_reported() {
    let (motion, attitudes) = motion();
    let bodies = vec![
        body("cup", Mount::Pad, cylinder(0.03, 0.0, 0.02)),
        body("stem", Mount::Stem, cylinder(0.01, 0.03, 0.2)),
    ];
    let pose = Pose::new([0.12, 0.27, 0.05], [0.2, 0.0, 0.5]);
    let clamp = Obstacle { name: "clamp".into(), pose, shape: cube(0.04) };
    let layup = layup(Grid { nu: 2, nv: 1 }, bodies, vec![clamp]);
    let found = Nearest::of_motion(&layup, LIMIT, 100.0, &motion, &attitudes).unwrap();
    let moves = Planned { motion: &motion, attitudes: &attitudes };
    let mut least = f64::INFINITY;
    for k in 0..=20_000 {
        let time = motion.duration() * f64::from(k) / 20_000.0;
        least = least.min(along(&layup, LIMIT, &moves, &[time], f64::INFINITY).unwrap().distance);
    }
    let resolution = 0.011 * found.distance.abs().max(LIMIT);
    assert!(found.distance > 0.0 && least >= found.distance - resolution, "{least} {found:?}");
    assert!(found.distance >= least - 1e-5, "{least} {found:?}");
}

/// Legs follow each other as the steps do.
#[test]
fn legs_are_straight_ways_one_after_the_other() {
    let poses = |x: f64| {
        let places = [[x, x * x, 0.0]];
        Poses::free(&places, &[[0.0, 0.0, 0.0, 1.0]], &places)
    };
    let legs = Legs(vec![
        Straight::new(&poses(0.0), &poses(1.0)),
        Straight::new(&poses(1.0), &poses(2.0)),
    ]);
    assert_eq!(legs.pose(Origin::Stem(0), 1.5).position, [1.5, 2.5, 0.0]);
    assert_eq!(legs.pose(Origin::Stem(0), 2.0).position, [2.0, 4.0, 0.0]);
    let travel = legs.travel(Origin::Pad(0), None, [1.0, 2.0]);
    assert!((travel - 10.0_f64.sqrt()).abs() < 1e-12, "{travel}");
}
