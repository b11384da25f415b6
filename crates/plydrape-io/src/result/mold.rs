//! A mold as a file holds it: what it is made from again.

use crate::read::formula;
use plydrape::mold::{
    Cylinder, Graph, HeightGrid, Layer, Layers, Mesh, Mold, Plane, Pose, Raised, Saddle, Sphere,
    Surface, Torus,
};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::sync::Arc;

/// What a mold is made from again.
#[derive(Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum Record<'a> {
    Plane(Plane),
    Cylinder(Cylinder),
    Sphere(Sphere),
    Torus(Torus),
    Graph { pose: Pose, surface: SurfaceRecord<'a>, domain: Option<[[f64; 2]; 2]> },
    Mesh { vertices: Cow<'a, [[f64; 3]]>, triangles: Cow<'a, [[u32; 3]]> },
    Layered { on: Box<Record<'a>>, layers: Vec<LayerRecord<'a>> },
}

/// A ply that lies on the mold.
#[derive(Serialize, Deserialize)]
struct LayerRecord<'a> {
    thickness: f64,
    rings: Cow<'a, [Vec<[f64; 2]>]>,
}

/// A height over x and y.
#[derive(Serialize, Deserialize)]
#[serde(tag = "surface", rename_all = "kebab-case")]
enum SurfaceRecord<'a> {
    Saddle(Saddle),
    Formula { z: Cow<'a, str> },
    HeightGrid { x: Cow<'a, [f64]>, y: Cow<'a, [f64]>, z: Cow<'a, [f64]> },
}

impl<'a> Record<'a> {
    /// The record of a mold; `None` of one that no result holds.
    fn new(mold: &'a Mold) -> Option<Self> {
        Some(match mold {
            Mold::Plane(plane) => Record::Plane(*plane),
            Mold::Cylinder(cylinder) => Record::Cylinder(*cylinder),
            Mold::Sphere(sphere) => Record::Sphere(*sphere),
            Mold::Torus(torus) => Record::Torus(*torus),
            Mold::Graph(Graph { pose, surface, domain }) => {
                let surface = match surface {
                    Surface::Saddle(saddle) => SurfaceRecord::Saddle(*saddle),
                    Surface::Formula { z } => SurfaceRecord::Formula { z: z.text().into() },
                    Surface::HeightGrid(grid) => {
                        let [x, y, z] = grid.nodes().map(Cow::from);
                        SurfaceRecord::HeightGrid { x, y, z }
                    }
                    // a search's own, which no result holds
                    Surface::Front(_) => return None,
                };
                Record::Graph { pose: *pose, surface, domain: *domain }
            }
            Mold::Mesh(mesh) => Record::Mesh {
                vertices: mesh.vertices().into(),
                triangles: mesh.triangles().into(),
            },
            Mold::Layered(layered) => Record::Layered {
                on: Box::new(Record::new(&layered.mold)?),
                layers: layered.relief.0.iter().map(LayerRecord::new).collect(),
            },
            Mold::Wavy(_) => return None,
        })
    }

    fn mold(self) -> Result<Mold, String> {
        // most molds are recorded as they are; formulas, height grids, meshes and layers are made again
        Ok(match self {
            Record::Plane(plane) => Mold::Plane(plane),
            Record::Cylinder(cylinder) => Mold::Cylinder(cylinder),
            Record::Sphere(sphere) => Mold::Sphere(sphere),
            Record::Torus(torus) => Mold::Torus(torus),
            Record::Graph { pose, surface, domain } => {
                let surface = match surface {
                    SurfaceRecord::Saddle(saddle) => Surface::Saddle(saddle),
                    SurfaceRecord::Formula { z } => {
                        Surface::Formula { z: formula::read(&z).map_err(|e| e.to_string())? }
                    }
                    SurfaceRecord::HeightGrid { x, y, z } => {
                        let [x, y, z] = [x, y, z].map(Cow::into_owned);
                        let grid = HeightGrid::new(x, y, z).map_err(|e| e.to_string())?;
                        Surface::HeightGrid(grid)
                    }
                };
                Mold::Graph(Graph { pose, surface, domain })
            }
            Record::Mesh { vertices, triangles } => {
                let mesh = Mesh::of_triangles(vertices.into_owned(), &triangles);
                Mold::Mesh(Arc::new(mesh.map_err(|e| e.to_string())?.0))
            }
            Record::Layered { on, layers } => {
                let layer = |record: LayerRecord| {
                    Layer::new(record.thickness, record.rings.into_owned())
                        .map_err(|e| e.to_string())
                };
                let layers = layers.into_iter().map(layer).collect::<Result<_, _>>()?;
                Mold::Layered(Arc::new(Raised { mold: on.mold()?, relief: Layers(layers) }))
            }
        })
    }
}

impl<'a> LayerRecord<'a> {
    fn new(layer: &'a Layer) -> Self {
        LayerRecord { thickness: layer.thickness(), rings: layer.rings().into() }
    }
}

/// Why a wavy mold is not written.
const WAVY: &str = "the mold has the waves of one draw of the scene's errors, which no result file holds: write the result of the scene itself, or draw without waviness";

/// Writes a mold, if there is one. A wavy one is refused: its drape must not be read as that of the plain mold.
pub fn serialize<S: Serializer>(mold: &Option<Mold>, to: S) -> Result<S::Ok, S::Error> {
    let recorded =
        |mold| Record::new(mold).ok_or_else(|| <S::Error as serde::ser::Error>::custom(WAVY));
    mold.as_ref().map(recorded).transpose()?.serialize(to)
}

/// Reads a mold, if there is one.
pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Mold>, D::Error> {
    let record = Option::<Record>::deserialize(from)?;
    record.map(Record::mold).transpose().map_err(D::Error::custom)
}
