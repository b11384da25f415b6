//! `plydrape new`: writes a commented scene to start from.

use crate::failure::{Done, Failure};
use crate::results;
use crate::watch::whole;
use plydrape_io::scene::TEMPLATE;
use plydrape_io::store::shown;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Write a commented scene to start from.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A folder for the scene, or a file that ends in .toml; what exists is not overwritten.
    name: PathBuf,
}

/// Writes `NAME.toml`, or `scene.toml` in a folder NAME.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let name = &arguments.name;
    let file = if name.extension().is_some_and(|ending| ending == "toml") {
        name.clone()
    } else {
        name.join("scene.toml")
    };
    let folder = file.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let made = !folder.exists();
    fs::create_dir_all(folder).map_err(|error| Failure::output(folder, &error))?;
    if let Err(error) = whole(|| put(&file, folder, TEMPLATE)) {
        if made {
            // only an empty folder goes, and only the one made here
            let _ = fs::remove_dir(folder);
        }
        return Err(Failure::output(&file, &error));
    }
    if !quiet {
        let shown = shown::path(&file);
        results::print(&format!("{shown} is written; next: plydrape check {shown}\n"), &[file])?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes a new file whole or not at all: beside its place, then moved there if nothing is in the way.
pub fn put(file: &Path, folder: &Path, text: &str) -> io::Result<()> {
    if file.symlink_metadata().is_ok() {
        return Err(ErrorKind::AlreadyExists.into());
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".plydrape-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // as any new file: what the umask leaves of it
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut new = builder.tempfile_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.as_file().sync_all()?;
    new.persist_noclobber(file).map(drop).map_err(|fault| fault.error)
}
