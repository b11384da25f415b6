//! The cell of a scene: how grippers hold the ply and how far all may be off, where the scene does not say so itself.

use super::errors::errors;
use super::file::{CellFile, CellTable, OrderKey};
use super::located::Located;
use super::quantity::read_or;
use super::source::Document;
use super::{check, read, settings, start};
use crate::Error;
use crate::store::shown;
use plydrape::layup::ReleaseOrder;
use plydrape::ply::Ply;
use plydrape::scene::{Cell, CellPreset};
use std::ops::Range;

/// The cell that a scene names.
pub(super) struct NamedCell {
    /// Name, or that of its file.
    pub name: String,
    /// Where the scene names it.
    pub span: Range<usize>,
    pub cell: Cell,
}

/// Reads the cell of the table `[cell]`, which is one of the program or a file beside the scene.
pub(super) fn cell(
    table: &Located<CellTable>,
    ply: &Ply,
    document: &Document,
) -> Result<NamedCell, Error> {
    let Located { value: name, span } = &table.value.preset;
    let found = CellPreset::ALL.iter().find(|preset| preset.name() == name);
    let cell = match found {
        Some(preset) => preset.cell(),
        None if !name.ends_with(".toml") => {
            return Err(document.error(
                span.clone(),
                format!("there is no cell {}", document.quoted(span)),
                "plydrape comes with \"usual\" and \"ideal\"; a file of your own is named with its ending, e.g. \"our_cell.toml\"",
            ));
        }
        None => {
            let file = read::text(&document.path(name), name, read::LARGEST_TOML)
                .map_err(|error| document.error_of_named(span, error, "scene"))?;
            from_file(&file, ply)?
        }
    };
    Ok(NamedCell { name: shown::name(name), span: span.clone(), cell })
}

fn from_file(document: &Document, ply: &Ply) -> Result<Cell, Error> {
    // a cell says where its numbers come from
    let file: CellFile = read::keys(document)?;
    match &file.source {
        Some(source) => check::line(source, document)?,
        None => {
            let first_line = document.text.find('\n').unwrap_or(document.text.len());
            return Err(document.error(
                0..first_line,
                format!("the cell file `{}` has no `source`", document.file),
                "say where its numbers come from, as in source = \"measured on our robot, 2026\"",
            ));
        }
    };

    // how grippers hold the ply, not where they are
    let mut cell = Cell::default();
    if let Some(Located { value: table, span }) = &file.grippers {
        if !start::is_open(table) || table.pad_radius.is_some() {
            return Err(document.error(
                span.clone(),
                "[grippers] of a cell says more than how grippers hold the ply",
                "keep `lip`, `stiffness`, `slip_force`, `holding_force` and `max_tilt`; the rest belongs into [grippers] of the scene",
            ));
        }
        cell = settings::held(table, &cell, document)?;
    }

    // when pads let go, and how far all may be off
    if let Some(table) = &file.release {
        cell.release = Some(table.order.map_or(ReleaseOrder::End, OrderKey::into));
        cell.dwell = read_or(&table.dwell, 0.0, document)?;
    }
    if let Some(table) = &file.errors {
        cell.errors = Some(errors(table, None, ply, true, document)?);
    }
    Ok(cell)
}

#[cfg(test)]
mod tests {
    use super::super::{SceneFile, parse};
    use super::*;
    use plydrape::errors::{Errors, Term};
    use plydrape::layup::Lip;
    use std::path::Path;

    const SCENE: &str = "ply.grippers = [2, 2]\nply.cell = [0.1, 0.1]\nply.material = \"krogh2018\"\n\
        grippers.spacing = [0.098, 0.098]\ngrippers.height = 0.1\n";

    fn scene(keys: &str, base: &Path) -> SceneFile {
        parse(&format!("{SCENE}{keys}\n"), base, "scene.toml").unwrap_or_else(|e| panic!("{e}"))
    }

    /// A preset as keys, which a file of a cell may have too.
    fn keys(preset: CellPreset) -> String {
        let line = |figure: &plydrape::scene::CellFigure| match figure.written.parse::<f64>() {
            Ok(_) => format!("{} = {}\n", figure.key, figure.written),
            Err(_) => format!("{} = \"{}\"\n", figure.key, figure.written),
        };
        preset.figures().iter().map(line).collect()
    }

    fn assert_same(a: &SceneFile, b: &SceneFile) {
        assert_eq!((a.layup.settings, a.errors), (b.layup.settings, b.errors));
        assert_eq!(a.layup.release, b.layup.release);
        assert_eq!((&a.layup.ply, &a.layup.motion), (&b.layup.ply, &b.layup.motion));
    }

    /// Each figure is what its key says, in a scene and in a file of a cell; the ideal cell is none.
    #[test]
    fn a_preset_equals_its_keys_written_out() {
        let folder = tempfile::tempdir().unwrap();
        let on_mold = |keys: &str| format!("mold.kind = \"plane\"\ntarget.origin = [0, 0]\n{keys}");
        for preset in CellPreset::ALL {
            let named =
                scene(&on_mold(&format!("cell.preset = \"{}\"", preset.name())), Path::new(""));
            assert_eq!(named.cell.as_deref(), Some(preset.name()));
            let keys = keys(*preset);
            assert_same(&named, &scene(&on_mold(&keys), Path::new("")));
            std::fs::write(folder.path().join("ours.toml"), format!("source = \"us\"\n{keys}"))
                .unwrap();
            assert_same(&named, &scene(&on_mold("cell.preset = \"ours.toml\""), folder.path()));
        }
        let usual = scene("cell.preset = \"usual\"", Path::new(""));
        let errors = usual.errors.expect("errors");
        assert_eq!(errors.material.shear, Term::Factor(2.0));
        assert!(usual.layup.settings.pad.gives() && usual.layup.settings.pad.lip.is_some());
        assert_eq!((errors.seed, errors.samples, errors.share), (0, 64, 0.95));
    }

    /// Pads let go of a ply on a mold in the order of their cell unless the scene has one, and hold a ply without a mold.
    #[test]
    fn pads_let_go_as_the_cell_says_unless_the_scene_does() {
        let order = |keys: &str| {
            let keys = format!("cell.preset = \"usual\"\n{keys}");
            let scene = scene(&keys, Path::new(""));
            scene.layup.release.as_ref().map(|rule| (rule.order, rule.dwell))
        };
        let mold = "mold.kind = \"plane\"\ntarget.origin = [0, 0]\n";
        assert_eq!(order(""), None);
        assert_eq!(order(mold), Some((ReleaseOrder::HollowsFirst, 0.0)));
        let dwell = format!("{mold}release.dwell = 2\n");
        assert_eq!(order(&dwell), Some((ReleaseOrder::HollowsFirst, 2.0)));
        let end = format!("{mold}release.order = \"end\"\n");
        assert_eq!(order(&end), Some((ReleaseOrder::End, 0.0)));
    }

    /// A key of the scene changes what it says and nothing else: a stiffness as a whole, an error term by term.
    #[test]
    fn keys_of_the_scene_stand_over_its_cell_one_by_one() {
        let with = |keys: &str| scene(&format!("cell.preset = \"usual\"\n{keys}"), Path::new(""));
        let cell = CellPreset::Usual.cell();
        let errors = cell.errors.expect("errors");
        let slip = with("grippers.slip_force = \"5 N\"").layup.settings;
        assert_eq!((slip.pad.slip_force, slip.pad.holding_force), (Some(5.0), Some(20.0)));
        assert_eq!(slip.max_tilt, cell.max_tilt);
        let tilt = with("grippers.max_tilt = 0.5").layup.settings;
        assert_eq!((tilt.max_tilt, tilt.pad), (0.5, cell.pad));
        let lip = |keys: &str| with(keys).layup.settings.pad.lip;
        let usual = cell.pad.lip.expect("a lip");
        let harder = Some(Lip { rigidity: 2e-3, ..usual });
        assert_eq!(lip("grippers.lip.rigidity = \"2 mN m\""), harder);
        assert_eq!(lip("grippers.lip.radius = 0"), None);
        let mount = with("grippers.stiffness = { lateral = 1000 }").layup.settings.pad;
        assert_eq!((mount.lateral_stiffness, mount.axial_stiffness), (Some(1000.0), None));
        assert!(!with("grippers.stiffness = {}").layup.settings.pad.gives());

        let few = with("errors.samples = 8").errors;
        assert_eq!(few, Some(Errors { samples: 8, ..errors }));
        let shear = with("errors.material.shear = { bound = 0 }").errors.expect("errors");
        assert_eq!(shear.material.shear, Term::Bound(0.0));
        assert_eq!(shear.material.bending, errors.material.bending);
    }

    /// A waviness of 1 mm needs waves of 50 mm or more, whether or not both are written in one file.
    #[test]
    fn a_wavelength_of_the_scene_fits_the_waviness_of_its_cell() {
        let folder = tempfile::tempdir().unwrap();
        let cell = "source = \"us\"\nerrors.mold = { waviness = { bound = \"1 mm\" }, wavelength = \"150 mm\" }\n";
        std::fs::write(folder.path().join("ours.toml"), cell).unwrap();
        let read = |length: &str| {
            let keys = format!(
                "mold.kind = \"plane\"\ntarget.origin = [0, 0]\ncell.preset = \"ours.toml\"\nerrors.mold.wavelength = \"{length}\"\n"
            );
            parse(&format!("{SCENE}{keys}"), folder.path(), "scene.toml")
        };
        let errors = read("60 mm").unwrap_or_else(|e| panic!("{e}")).errors.expect("errors");
        assert_eq!((errors.mold.waviness, errors.mold.wavelength), (Term::Bound(1e-3), 0.06));
        let Err(refused) = read("10 mm") else { panic!("waves of 1 mm are 10 mm long") };
        assert!(refused.to_string().contains("50 mm or more"), "{refused}");
    }
}
