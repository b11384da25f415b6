//! Two pictures of a net as SVG: its shear on the flat fabric ([`shear_map`]), and what each seed costs ([`seeds`]).
//!
//! Same net, same bytes. The ply in 3D is on the page and in the files for VTK.

mod axes;
mod bar;
mod canvas;
mod color;
pub mod seeds;
pub mod shear_map;

pub(crate) use color::viridis_rgb;

/// Most characters of a picture's title.
const TITLE: usize = 60;
