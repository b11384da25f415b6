"""The rows of a study, and their summary."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .error import StudyError, require
from .folder import LAST, Folder, joined, read_manifest

if TYPE_CHECKING:
    import pyarrow as pa


class Outcome:
    """Rows of a study.

    Attributes
    ----------
    title
        Of the study.
    folder
        Its folder, or None if it is in memory only.
    ran
        Number of scenarios that the run had left; 0 where the study was finished before.
    written
        Names of the files that the run wrote there besides rows.

    Examples
    --------
    >>> outcome = plydrape.study.read("study.results")  # doctest: +SKIP
    >>> outcome.table().to_pandas()  # doctest: +SKIP

    """

    def __init__(self, rows: pa.Table, title: str, folder: Path | None) -> None:
        """Takes rows in the order of their scenarios."""
        self._rows = rows
        self.title = title
        self.folder = folder
        self.ran = 0
        self.written: list[str] = []

    def __repr__(self) -> str:
        """In a line: `<plydrape.study.Outcome 256 rows, 12.5 % accepted>`."""
        share = self.accepted_share
        accepted = "none draped" if share is None else f"{100 * share:.1f} % accepted"
        return f"<plydrape.study.Outcome {self._rows.num_rows} rows, {accepted}>"

    def table(self) -> pa.Table:
        """All rows, one a scenario. Units are in the metadata of the fields as `unit`.

        Returns
        -------
        pa.Table
            The rows as an Arrow table.

        Examples
        --------
        >>> import tempfile
        >>> scene = "examples/02_hanging_strip/scene.toml"
        >>> vary = {"ply.material.mass": {"values": [0.3, 0.32]}}
        >>> table = {"scene": scene, "sampling": "grid", "vary": vary}
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     outcome = plydrape.study.run(table, output=folder, workers=1, progress=False)
        >>> outcome.table()["ply.material.mass"].to_pylist()
        [0.3, 0.32]

        """
        return self._rows

    @property
    def inputs(self) -> list[str]:
        """Names of the columns of inputs."""
        names = self._rows.column_names
        end = next((i for i, name in enumerate(names) if name == "accepted"), len(names))
        return [name for name in names[:end] if name not in ("scenario", *LAST)]

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Counts, distributions and rank correlations, as in summary.json."""
        from . import summary

        return summary.summary(self._rows, self.inputs)

    @property
    def accepted_share(self) -> float | None:
        """Accepted drapes as a share of those that were draped; None where none was."""
        share = self.summary["accepted"]["share"]
        return None if share is None else float(share)

    @property
    def correlations(self) -> dict[str, dict[str, float | None]]:
        """Spearman's rank correlation of each measure with each input.

        None where either is constant.
        """
        return {name: entry["correlations"] for name, entry in self.summary["measures"].items()}


def read(folder: str | os.PathLike[str]) -> Outcome:
    """The rows of a study's folder, also of a study that is not finished.

    Parameters
    ----------
    folder : str or path
        The folder of a study.

    Returns
    -------
    Outcome
        Its rows.

    Raises
    ------
    StudyError
        It is no study's folder, or has no rows yet.

    Examples
    --------
    >>> import tempfile
    >>> scene = "examples/02_hanging_strip/scene.toml"
    >>> vary = {"ply.material.mass": {"values": [0.3, 0.32]}}
    >>> table = {"scene": scene, "sampling": "grid", "vary": vary}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = plydrape.study.run(table, output=folder, workers=1, progress=False)
    ...     plydrape.study.read(folder).accepted_share
    1.0

    """
    require("scipy", "pyarrow", "pandas")
    path = Path(folder)
    definition = read_manifest(path)["definition"]
    parts = Folder(path).parts()
    if not parts:
        raise StudyError(f"`{path}` has no rows yet", help="run the study")
    return Outcome(joined([rows for _, rows in parts]), definition["title"], path)
