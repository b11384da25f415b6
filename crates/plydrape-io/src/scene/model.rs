//! Which models drape a scene, and whether each of them can.

use super::cell::NamedCell;
use super::file::{MethodKey, MountTable, SceneKeys};
use super::located::Located;
use super::sheet;
use super::source::Document;
use crate::Error;
use crate::store::size::PlanSheets;
use plydrape::Error as Cause;
use plydrape::layup::{Layup, Model, Settings};
use plydrape::outcome::check_model;
use plydrape::ply::Ply;
use std::ops::Range;

/// The models of a scene.
pub(super) struct Models<'a> {
    file: &'a SceneKeys,
    document: &'a Document,
    /// The one that decides.
    decides: Model,
    /// The one that is draped beside it, and where the scene says so.
    also: Option<(Model, &'a Range<usize>)>,
}

impl<'a> Models<'a> {
    /// The models that a scene names; refuses one that is named twice.
    pub fn named(
        file: &'a SceneKeys,
        decides: Model,
        document: &'a Document,
    ) -> Result<Self, Error> {
        let also = file.model.also.as_ref();
        let also = also.map(|Located { value, span }| (Model::from(*value), span));
        let models = Models { file, document, decides, also };
        match also {
            Some((also, span)) if also == decides => Err(models.error(
                span,
                "the model to be draped beside the one that decides is that one",
                "leave out `also`, or name the other model there",
            )),
            _ => Ok(models),
        }
    }

    /// Whether the model that does not decide is draped too.
    pub fn has_also(&self) -> bool {
        self.also.is_some()
    }

    /// Refuses catenaries where no lines run between the cups, and the stepwise planner where these are no whole array.
    pub fn check_lines(&self, ply: &Ply) -> Result<(), Error> {
        let lines = ply.lines();
        let stepwise = matches!(self.file.plan.method, Some(MethodKey::Stepwise));
        let sheet = "drape and plan it with the sheet, as kind = \"sheet\" in [model] and method = \"path\" in [plan] do";
        if stepwise && lines.whole_array().is_none() {
            let what = "the stepwise planner follows catenaries between the cups of a whole array along the yarns, and the cups that hold this ply are no such array";
            return Err(self.error(self.file.grippers_span(), what, sheet));
        }
        if !lines.is_empty() {
            return Ok(());
        }
        let what = "no catenaries hang between the cups that hold this ply: not each of them shares a yarn with another one, as in rows along the yarns or at 45° to them";
        match (self.decides, self.also) {
            (Model::Catenaries, _) => Err(self.error(self.file.grippers_span(), what, sheet)),
            (_, Some((Model::Catenaries, span))) => {
                Err(self.error(span, what, "leave out `also`: the sheet alone can drape it"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses mounts that give where catenaries hold the grippers: as a model, or in the stepwise planner. They are those of the scene, or of
    /// its cell.
    pub fn check_mounts(&self, cell: Option<&NamedCell>) -> Result<(), Error> {
        // the mounts that give: those of the scene, or of its cell where the scene says nothing about them
        let grippers = self.file.grippers.as_ref();
        let mounts = grippers.and_then(|table| table.value.stiffness.as_ref());
        let gives = |mount: &&Located<MountTable>| {
            mount.value.lateral.is_some() || mount.value.axial.is_some()
        };
        let cell = cell.filter(|named| mounts.is_none() && named.cell.pad.gives());
        let own = mounts.filter(gives).map(|mounts| &mounts.span);
        let Some(span) = own.or(cell.map(|named| &named.span)) else { return Ok(()) };

        // what holds grippers rigidly: the model that decides, the one beside it, or the planner
        let stepwise = matches!(self.file.plan.method, Some(MethodKey::Stepwise));
        let (what, help) = match (self.decides, self.also) {
            (Model::Catenaries, _) => (
                "catenaries hold their grippers rigidly, and these mounts give",
                "take kind = \"sheet\" in [model], or leave out `stiffness`",
            ),
            (_, Some((Model::Catenaries, _))) => (
                "the catenaries beside the sheet hold their grippers rigidly, and these mounts give",
                "leave out `also` in [model], or `stiffness`",
            ),
            _ if stepwise => (
                "the stepwise planner follows catenaries, which hold their grippers rigidly, and these mounts give",
                "plan it with method = \"path\" in [plan], or leave out `stiffness`",
            ),
            _ => return Ok(()),
        };

        // the message says so where the mounts are those of the cell
        match cell {
            None => Err(self.document.error(span.clone(), what, help)),
            Some(named) => Err(self.document.error(
                span.clone(),
                what.replace("these mounts", &format!("the mounts of the cell \"{}\"", named.name)),
                format!(
                    "take preset = \"ideal\" in [cell]; or {}",
                    help.replace("`stiffness`", "[cell]")
                ),
            )),
        }
    }

    /// Refuses a sheet that material, pads, mesh or memory do not allow. Returns the sheets of a plan; `None` where catenaries decide.
    pub fn check_sheets(
        &self,
        ply: &Ply,
        settings: &Settings,
        steps: usize,
    ) -> Result<Option<PlanSheets>, Error> {
        let fits =
            |otherwise| sheet::fits(self.file, ply, settings, steps, otherwise, self.document);
        match (self.decides, self.also) {
            (Model::Sheet, _) => {
                fits("write kind = \"catenaries\" in [model], which need none of that").map(Some)
            }
            (_, Some((Model::Sheet, _))) => {
                fits("leave out `also` in [model]: catenaries need none of that").map(|_| None)
            }
            _ => Ok(None),
        }
    }

    /// Refuses a layup that a model cannot be made of, whatever it lacks.
    pub fn check_built(&self, layup: &Layup) -> Result<(), Error> {
        let named = [Some(self.decides), self.also.map(|(model, _)| model)];
        for model in named.into_iter().flatten() {
            if let Err(fault) = check_model(layup, model) {
                let pads = self.file.grippers.as_ref();
                let pads = pads.and_then(|grippers| grippers.value.pad_radius.as_ref());
                let span = pads.map_or(self.file.grippers_span(), |radius| &radius.span);
                return Err(self.error(span, &fault.to_string(), remedy(&fault)));
            }
        }
        Ok(())
    }

    /// A fault at a place of the scene; at none where a caller of the program has named the model.
    fn error(&self, span: &Range<usize>, message: &str, help: &str) -> Error {
        match span.is_empty() {
            true => self.document.error_anywhere(message, help),
            false => self.document.error(span.clone(), message, help),
        }
    }
}

/// What helps where a model cannot be made.
fn remedy(fault: &Cause) -> &'static str {
    match fault {
        Cause::NoCatenaries | Cause::CatenariesMounts { .. } => "write kind = \"sheet\" in [model]",
        Cause::SheetPadSmall { .. } | Cause::SheetPadPoint { .. } => {
            "give a larger `pad_radius` in [grippers], or a finer `mesh` in [sheet]"
        }
        Cause::SheetPadOff { .. } | Cause::SheetPadsOverhang { .. } => {
            "give a smaller `pad_radius` in [grippers], or more fabric around the grippers"
        }
        _ => "mend that, or choose the other model by `kind` in [model]",
    }
}

#[cfg(test)]
mod tests {
    use super::super::{parse, read_for};
    use super::*;
    use std::path::Path;

    const SCENE: &str = "[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
        [grippers]\nspacing = [0.098, 0.098]\nheight = 0.1\n";

    /// The model beside is the other one, whether the scene names it or a caller does; a caller's model takes the place of the scene's.
    #[test]
    fn the_model_beside_is_the_one_that_does_not_decide() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.toml");
        let scene = |keys: &str| format!("{SCENE}[model]\n{keys}\n");
        assert!(!parse(&scene(""), Path::new(""), "").unwrap().also);
        assert!(parse(&scene("also = \"catenaries\""), Path::new(""), "").unwrap().also);
        let fault = parse(&scene("also = \"sheet\""), Path::new(""), "").unwrap_err();
        assert!(
            fault.message().contains("is that one") && fault.diagnostic().unwrap().span.is_some(),
            "{fault}"
        );

        std::fs::write(&file, scene("also = \"catenaries\"")).unwrap();
        let read = |model, also| read_for(&file, model, also);
        assert!(read(None, None).unwrap().also);
        let catenaries = read(Some(Model::Catenaries), None).unwrap();
        assert_eq!((catenaries.layup.settings.model, catenaries.also), (Model::Catenaries, false));
        assert!(read(Some(Model::Catenaries), Some(Model::Sheet)).unwrap().also);
        let fault = read(None, Some(Model::Sheet)).unwrap_err();
        assert!(
            fault.message().contains("is that one") && fault.diagnostic().unwrap().span.is_none(),
            "{fault}"
        );
    }
}
