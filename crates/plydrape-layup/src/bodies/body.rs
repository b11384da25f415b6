//! What moves with grippers and robot, and what stands in the cell.

use super::solid::Solid;
use super::surface::Surface;
use crate::mold::{Mesh, Pose, distance};
use std::sync::{Arc, OnceLock};

/// The shape of a body, in the coordinates of what it is mounted on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case", deny_unknown_fields))]
pub enum Shape {
    /// A cylinder about the z axis.
    Cylinder {
        /// Radius (m).
        radius: f64,
        /// Where along z it begins (m).
        from: f64,
        /// Where it ends (m), above `from`.
        to: f64,
    },
    /// A box with sides along the axes.
    Box {
        /// Lengths of its sides (m).
        size: [f64; 3],
        /// Middle (m).
        at: [f64; 3],
    },
    /// Triangles; of a closed surface, counterclockwise as seen from outside.
    Mesh {
        /// Corners (m).
        vertices: Vec<[f64; 3]>,
        /// Indices of the corners of each triangle.
        triangles: Vec<[u32; 3]>,
    },
}

impl Shape {
    /// The box around it: lowest and highest coordinates (m).
    #[must_use]
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        match self {
            Shape::Cylinder { radius: r, from, to } => [[-r, -r, *from], [*r, *r, *to]],
            Shape::Box { size, at } => {
                [-0.5, 0.5].map(|side| [0, 1, 2].map(|n| at[n] + side * size[n]))
            }
            Shape::Mesh { vertices, .. } => {
                let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
                for p in vertices {
                    for n in 0..3 {
                        (low[n], high[n]) = (low[n].min(p[n]), high[n].max(p[n]));
                    }
                }
                [low, high]
            }
        }
    }

    /// The middle of the box around it (m), and its farthest distance from there (m).
    #[must_use]
    pub fn ball(&self) -> ([f64; 3], f64) {
        let [low, high] = self.bounds();
        let middle = [0, 1, 2].map(|n| 0.5 * (low[n] + high[n]));
        let reach = match self {
            Shape::Cylinder { radius, from, to } => radius.hypot(0.5 * (to - from)),
            Shape::Box { size: [x, y, z], .. } => 0.5 * x.hypot(*y).hypot(*z),
            Shape::Mesh { vertices, .. } => {
                vertices.iter().map(|p| distance(*p, middle)).fold(0.0, f64::max)
            }
        };
        (middle, reach)
    }

    /// A segment along the longest side of the box around it (m), and the farthest distance of its points from there (m): of long bodies
    /// far less than the radius of the ball.
    #[must_use]
    pub fn capsule(&self) -> ([[f64; 3]; 2], f64) {
        let [low, high] = self.bounds();
        let half = [0, 1, 2].map(|n| 0.5 * (high[n] - low[n]));
        let long = match self {
            Shape::Cylinder { .. } => 2,
            _ => (0..3).max_by(|a, b| half[*a].total_cmp(&half[*b])).unwrap_or(2),
        };
        let radius = match self {
            Shape::Cylinder { radius, .. } => *radius,
            _ => half[(long + 1) % 3].hypot(half[(long + 2) % 3]),
        };
        let middle = self.ball().0;
        let end = |side: f64| {
            let mut end = middle;
            end[long] += side * half[long];
            end
        };
        ([end(-1.0), end(1.0)], radius)
    }
}

/// What a body moves with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Mount {
    /// The pad of each gripper. Its origin is the gripper's point on the ply, z is the ply's normal there, and x runs along u: it
    /// tilts with the ply.
    Pad,
    /// The stem of each gripper. Its origin is where the robot holds the gripper's point; it is turned as the tool is, and upright
    /// where each gripper moves by itself.
    Stem,
    /// The robot's flange, of which there is one.
    Flange,
    /// A link of the robot's arm: 0 is its foot, and each other one is what that joint carries.
    Link(usize),
}

/// A body that moves.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Body {
    /// Name for reports.
    pub name: String,
    /// What it moves with; there is one on every gripper, or one on the flange or a link.
    pub on: Mount,
    /// Shape in the coordinates of that.
    pub shape: Shape,
}

/// Something that stands in the cell.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Obstacle {
    /// Name for reports.
    pub name: String,
    /// Where it stands, in the frame of the scene.
    pub pose: Pose,
    /// Shape in coordinates of its own.
    pub shape: Shape,
}

impl Obstacle {
    /// The box around it in the frame of the scene, as far as the box around its shape reaches: lowest and highest coordinates (m).
    #[must_use]
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        let own = self.shape.bounds();
        let corner = |n: usize| self.pose.place([0, 1, 2].map(|c| own[n >> c & 1][c]));
        let end = |start: f64, extreme: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|c| (0..8).map(|n| corner(n)[c]).fold(start, extreme))
        };
        [end(f64::INFINITY, f64::min), end(f64::NEG_INFINITY, f64::max)]
    }
}

/// The bodies and obstacles of a scene.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Bodies {
    bodies: Arc<[Body]>,
    obstacles: Arc<[Obstacle]>,
    /// What distances need of them, made when it is first asked for.
    #[cfg_attr(feature = "serde", serde(skip))]
    made: Made,
}

impl Bodies {
    /// Bodies and obstacles from lists.
    #[must_use]
    pub fn new(bodies: Vec<Body>, obstacles: Vec<Obstacle>) -> Self {
        Bodies { bodies: bodies.into(), obstacles: obstacles.into(), made: Made::default() }
    }

    /// Bodies on the arm alone, and all obstacles.
    #[must_use]
    pub fn of_arm(&self) -> Bodies {
        let links = self.bodies.iter().filter(|body| matches!(body.on, Mount::Link(_)));
        Bodies::new(links.cloned().collect(), self.obstacles.to_vec())
    }

    /// Whether there is nothing that moves, so that nothing is judged.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Whether there is neither a body nor an obstacle.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        self.bodies.is_empty() && self.obstacles.is_empty()
    }

    /// What moves.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// What stands in the cell.
    #[must_use]
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// What distances need of them.
    pub(crate) fn made(&self) -> &Solids {
        self.made.0.get_or_init(|| {
            let solid = |shape: &Shape| Solid::new(shape);
            Arc::new(Solids {
                bodies: self.bodies.iter().map(|body| solid(&body.shape)).collect(),
                surfaces: self.bodies.iter().map(|body| Surface::new(&body.shape)).collect(),
                obstacles: self.obstacles.iter().map(|body| solid(&body.shape)).collect(),
                mold: OnceLock::new(),
            })
        })
    }
}

/// What distances need of bodies and obstacles.
#[derive(Debug)]
pub(crate) struct Solids {
    pub bodies: Vec<Solid>,
    /// The surface of each body.
    pub surfaces: Vec<Surface>,
    pub obstacles: Vec<Solid>,
    /// The mold of triangles that was asked for first.
    mold: OnceLock<(Arc<Mesh>, Arc<Solid>)>,
}

impl Solids {
    /// A mold of triangles as a body.
    pub fn of_mesh(&self, mesh: &Arc<Mesh>) -> Arc<Solid> {
        let make = || {
            let (vertices, triangles) = (mesh.vertices().to_vec(), mesh.triangles().to_vec());
            Arc::new(Solid::new(&Shape::Mesh { vertices, triangles }))
        };
        let (made, solid) = self.mold.get_or_init(|| (Arc::clone(mesh), make()));
        if Arc::ptr_eq(made, mesh) { Arc::clone(solid) } else { make() }
    }
}

/// [`Solids`] once they are made; no part of what the bodies are.
#[derive(Debug, Clone, Default)]
struct Made(OnceLock<Arc<Solids>>);

impl PartialEq for Made {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
