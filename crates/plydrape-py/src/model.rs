//! The models of the ply that a call asks for.

use crate::error;
use crate::scene::{Origin, Scene};
use plydrape::layup::Model;
use plydrape::outcome::check_model;
use plydrape_io::result::sheet::SheetSize;
use plydrape_io::scene::{SceneFile, parse_for};
use plydrape_io::{Diagnostic, Error};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// The name of a model in Python.
pub fn name(model: Model) -> &'static str {
    match model {
        Model::Sheet => "sheet",
        Model::Catenaries => "catenaries",
    }
}

/// The model of a name; `argument` is what it was given for.
fn named(name: &str, argument: &str) -> PyResult<Model> {
    match name {
        "sheet" => Ok(Model::Sheet),
        "catenaries" => Ok(Model::Catenaries),
        other => {
            let text = format!("{argument} is {other:?}; expected \"sheet\" or \"catenaries\"");
            Err(PyValueError::new_err(text))
        }
    }
}

/// The scene with the models that a call asks for: the one that decides, and the one beside it. Refuses models that cannot drape it, in
/// the words of the command line.
pub fn for_models(
    scene: &Scene,
    model: Option<&str>,
    also: Option<&str>,
) -> PyResult<Arc<SceneFile>> {
    let Scene(file, origin) = scene;
    let asked = [
        model.map(|name| named(name, "model")).transpose()?,
        also.map(|name| named(name, "also")).transpose()?,
    ];
    let own = file.layup.settings.model;
    let decides = asked[0].unwrap_or(own);
    // what the scene has beside its own model may be the one that decides now
    let kept = file.also.then(|| own.other()).filter(|beside| *beside != decides);
    let beside = asked[1].or(kept);

    let mut file = Arc::clone(file);
    if (decides, beside.is_some()) != (own, file.also) {
        let scene = Arc::make_mut(&mut file);
        scene.layup.settings.model = decides;
        scene.also = beside.is_some();
    }
    match fault(&file, decides, beside) {
        None => Ok(file),
        Some(fault) => Err(error::diagnostic(&located(&file, origin, asked).unwrap_or(fault))),
    }
}

/// Why a scene is not draped by these models.
fn fault(file: &SceneFile, decides: Model, beside: Option<Model>) -> Option<Diagnostic> {
    if beside == Some(decides) {
        return Some(error::refused(
            "the model to be draped beside the one that decides is that one",
            "leave out `also`, or name the other model there",
        ));
    }
    for model in [Some(decides), beside].into_iter().flatten() {
        let sound = check_model(&file.layup, model).map_err(Error::from);
        let sheet = || (model == Model::Sheet).then(|| SheetSize::new(file)).transpose();
        if let Err(error) = sound.and_then(|()| sheet()) {
            return Some(error::refused(&error, error.help()));
        }
    }
    (decides == Model::Catenaries && file.layup.release.is_some()).then(|| {
        error::refused(
            "catenaries hang from grippers that hold them: they cannot follow a ply that pads let go of",
            "drape it with the sheet, or leave out `release`",
        )
    })
}

/// The fault with its place in the text of the scene, if that is known.
fn located(
    file: &SceneFile,
    origin: &Origin,
    [model, also]: [Option<Model>; 2],
) -> Option<Diagnostic> {
    let made = file.layup.mold.clone().filter(|_| origin.mold);
    let text = file.input.as_deref()?;
    match parse_for(text, &origin.base, "scene", made, model, also) {
        Err(Error::Scene(fault)) => Some(*fault),
        _ => None,
    }
}
