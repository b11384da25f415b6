# Made by scripts/stubs from crates/plydrape-py.

import typing

import matplotlib.figure
import numpy.typing
import pandas
import plydrape.limits
import plydrape.notebook
import pyvista
import xarray

"""
The compiled part of `plydrape`.
"""

from os import PathLike
from pathlib import Path
from typing import Any, Final, SupportsFloat, SupportsIndex, final

from _typeshed import SupportsGetItem
from numpy import bool_, float64, int64, uint32
from numpy.typing import ArrayLike, NDArray
from plydrape.limits import Limits

__all__ = [
    "__version__",
    "ClosestPoints",
    "Drape",
    "Equilibria",
    "Equilibrium",
    "Jacobian",
    "Material",
    "Measure",
    "Mold",
    "Net",
    "Outcome",
    "Plan",
    "Ply",
    "Result",
    "Sample",
    "Scene",
    "Sheet",
    "Solver",
    "Span",
    "Surface",
    "_restore",
    "_si",
    "_state",
    "equilibria",
    "fit",
    "materials",
    "measures",
    "outcome",
    "plan",
    "simulate",
    "simulate_all",
]

__version__: Final[str]
"""
Version of the package and of the library in it.
"""

@final
class ClosestPoints:
    """
    What lies closest to points.

    Examples
    --------
    >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
    >>> closest = mold.closest_points([[0, 0, 0.1]])
    >>> bool(np.isclose(np.linalg.norm(closest.points - [0, 0, 0.1]), abs(closest.distances[0])))
    True
    """
    @property
    def beyond(self, /) -> NDArray[bool_]:
        """
        Where a point is off to the side of an open boundary: there is no mold, shape (n,).
        """
    @property
    def distances(self, /) -> NDArray[float64]:
        """
        Distances (m), negative inside the mold, shape (n,).
        """
    @property
    def normals(self, /) -> NDArray[float64]:
        """
        Smooth unit normals of the mold there, out of it, shape (n, 3).
        """
    @property
    def points(self, /) -> NDArray[float64]:
        """
        The closest points of the mold (m), shape (n, 3).
        """

@final
class Drape:
    """
    A drape by the model that does not decide, `Result.also`: grippers, loads and measures of every step, and no verdict.

    Arrays are as those of `Result`.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> beside = plydrape.simulate(scene, also="catenaries").also
    >>> beside
    <plydrape.Drape by the catenaries, 30 steps>
    >>> beside.loads.shape, "height_mm" in beside.measures
    ((30, 8, 3), False)
    """
    def __repr__(self, /) -> str: ...
    @property
    def commanded(self, /) -> NDArray[float64]:
        """
        Where the robot holds the grippers (m), shape (steps, grippers, 3): their positions where their mounts are rigid.
        """
    @property
    def first_contact_step(self, /) -> int | None:
        """
        First step in which the ply touches the mold; None if it does not.
        """
    @property
    def loads(self, /) -> NDArray[float64]:
        """
        Force of the ply on each gripper (N), shape (steps, grippers, 3).
        """
    @property
    def measures(self, /) -> dict[str, NDArray[float64]]:
        """
        The worst value of every measure of the model in each step, by name, each of shape (steps,); nan where it has no meaning in
        a step. The unit is part of the name, ratios have none. A measure that the model does not evaluate is not there.
        """
    @property
    def model(self, /) -> str:
        """
        The model that draped: "sheet" or "catenaries".
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Positions of the grippers (m), shape (steps, grippers, 3): where they hold the fabric.
        """
    @property
    def quaternions(self, /) -> NDArray[float64]:
        """
        Orientations of the grippers as quaternions x, y, z, w, shape (steps, grippers, 4): z along the ply's normal, x along
        u.
        """
    @property
    def summary(self, /) -> dict[str, Any]:
        """
        How the drape came out: the `summary` of `also` in result.json.
        """
    @property
    def tilts_deg(self, /) -> NDArray[float64]:
        """
        Angles between the ply's normal at the grippers and their stems, which are upright unless a tool turns them (°), shape
        (steps, grippers).
        """
    @property
    def times(self, /) -> NDArray[float64]:
        """
        Time of each step (s), shape (steps,).
        """

@final
class Equilibria:
    """
    Many equilibria of one ply. Catenaries are counted as in `Ply`.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> batch = plydrape.batch.equilibria(plydrape.Solver.of(scene), scene.positions[:20])
    >>> len(batch), batch.slopes.shape
    (20, (20, 16, 2))
    """
    def __len__(self, /) -> int: ...
    def __repr__(self, /) -> str: ...
    @property
    def converged(self, /) -> NDArray[bool_]:
        """
        Whether each was found, shape (n,).
        """
    @property
    def forces(self, /) -> NDArray[float64]:
        """
        Horizontal forces (N), shape (n, catenaries); nan of stretched diagonals and straight catenaries.
        """
    @property
    def iterations(self, /) -> NDArray[int64]:
        """
        Iterations on the shared slopes, shape (n,).
        """
    @property
    def shear(self, /) -> NDArray[float64]:
        """
        Shear angles (rad), shape (n, cells); 0 where no diagonal is stretched.
        """
    @property
    def slopes(self, /) -> NDArray[float64]:
        """
        Slopes at the ends of each catenary, shape (n, catenaries, 2).
        """

@final
class Equilibrium:
    """
    A ply that hangs: forces, slopes, shape, and how they change.

    Catenaries are counted as in `Ply`.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    >>> equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
    >>> equilibrium.forces.round(4)
    array([0.4177])
    """
    def __repr__(self, /) -> str: ...
    @property
    def early_ends(self, /) -> dict[str, int]:
        """
        How often a part of the solve ended early or was replaced, by name; all zero in a plain solve.
        """
    @property
    def forces(self, /) -> NDArray[float64]:
        """
        Horizontal force of each catenary (N), shape (catenaries,); nan of a stretched diagonal or a straight one.
        """
    @property
    def iterations(self, /) -> int:
        """
        Iterations on the shared slopes.
        """
    def jacobian(self, /, *, wrt: typing.Literal["grippers", "lengths", "material"]) -> Jacobian:
        """
        Exact derivatives of the equilibrium, by the implicit function theorem.

        They hold where the equilibrium is smooth: not where a diagonal just begins to shear, or a slope just
        reaches its limit.

        Parameters
        ----------
        wrt : {"grippers", "lengths", "material"}
            To what: "grippers", their positions (m), axes (grippers, 3); "lengths", the fabric of a cell along
            u and v (m), axis (2,); "material", its `names`, axis (names,): mass and rigidities in SI units.

        Returns
        -------
        Jacobian
            The derivatives.

        Raises
        ------
        ValueError
            If there is no such `wrt`, or the derivatives would take more memory than allowed.
        SolveError
            If the equilibrium was not found, or a rigidity is zero: it has no neighborhood.

        Examples
        --------
        >>> ply = plydrape.Ply(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018")
        >>> equilibrium = plydrape.Solver(ply).solve([[0, 0, 0], [0.098, 0, 0]])
        >>> jacobian = equilibrium.jacobian(wrt="grippers")
        >>> jacobian.forces.shape, jacobian.points(5).shape
        ((1, 2, 3), (1, 5, 3, 2, 3))
        """
    @property
    def length_residual(self, /) -> float:
        """
        Largest error of a fabric length, as a share of it.
        """
    def points(self, /, stations: SupportsIndex = 17) -> NDArray[float64]:
        """
        Points along each catenary (m) at equal parts of its run, shape (catenaries, stations, 3).

        Parameters
        ----------
        stations : int, default 17
            How many points on each catenary, 2 or more.

        Returns
        -------
        ndarray
            The points (m), shape (catenaries, stations, 3).

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> equilibrium = plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]])
        >>> lowest = equilibrium.points(5)[0, 2]
        >>> (lowest * 1e3).round(1)
        array([49. ,  0. , -8.7])
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Positions of the grippers (m), shape (grippers, 3).
        """
    @property
    def residual(self, /) -> float:
        """
        What is left of the rule of the slopes, scaled to a slope.
        """
    @property
    def shear(self, /) -> NDArray[float64]:
        """
        Shear angle of each cell (rad), shape (cells,), those along u first; 0 where no diagonal is stretched.
        """
    @property
    def slopes(self, /) -> NDArray[float64]:
        """
        Slopes at the ends of each catenary, shape (catenaries, 2).
        """
    @property
    def status(self, /) -> str:
        """
        How the solve ended: "converged", "stalled", "iteration-limit" or "length-not-met".
        """

@final
class Jacobian:
    """
    Derivatives of an `Equilibrium`: each array has the axes of what is differentiated, then those of `wrt`.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    >>> equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
    >>> jacobian = equilibrium.jacobian(wrt="lengths")
    >>> jacobian.names, jacobian.forces.shape, jacobian.slopes.shape
    (['u', 'v'], (1, 2), (1, 2, 2))
    """
    @property
    def forces(self, /) -> NDArray[float64]:
        """
        Derivatives of the forces (N), shape (catenaries, …); nan where there is no force.
        """
    @property
    def names(self, /) -> list[str]:
        """
        What the last axis stands for: "x", "y", "z"; "u", "v"; or keys of the material.
        """
    def points(self, /, stations: SupportsIndex = 17) -> NDArray[float64]:
        """
        Derivatives of the points (m) at fixed parts of the runs, shape (catenaries, stations, 3, …).

        Parameters
        ----------
        stations : int, default 17
            How many points on each catenary, 2 or more.

        Returns
        -------
        ndarray
            The derivatives, shape (catenaries, stations, 3, …).

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> equilibrium = plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]])
        >>> equilibrium.jacobian(wrt="material").points(5).shape
        (1, 5, 3, 2)
        """
    @property
    def shear(self, /) -> NDArray[float64]:
        """
        Derivatives of the shear angles (rad), shape (cells, …); 0 where no diagonal is stretched.
        """
    @property
    def slopes(self, /) -> NDArray[float64]:
        """
        Derivatives of the end slopes, shape (catenaries, 2, …).
        """

@final
class Material:
    """
    What a ply is made of: mass, flexural rigidity, tension, shear curve and locking angle.

    Examples
    --------
    >>> material = plydrape.Material.shipped("krogh2018")
    >>> material.mass, material.flexural_rigidity
    (0.3143, 9e-06)
    """
    def __repr__(self, /) -> str: ...
    @property
    def areal(self, /) -> bool:
        """
        Whether its numbers are per area; else they belong to each catenary, as in Krogh et al. 2018.
        """
    @property
    def bending_rigidity(self, /) -> tuple[float, float] | None:
        """
        Bending rigidity per width along warp and weft (N·m), at rest where the moment is a table; None unless `areal`.
        """
    @property
    def flexural_rigidity(self, /) -> float | None:
        """
        Flexural rigidity EI of a catenary (N·m²); None if `areal`.
        """
    @property
    def locking_angle(self, /) -> float | None:
        """
        Shear angle at which the weave locks (rad), where it is known.
        """
    @property
    def mass(self, /) -> float:
        """
        Mass per length (kg/m), or per area (kg/m²) if `areal`.
        """
    def moment(self, /, curvatures: ArrayLike) -> NDArray[float64] | None:
        """
        Bending moment per width at curvatures, along warp and weft; None unless `areal`.

        Parameters
        ----------
        curvatures : array_like
            Curvatures (1/m), shape (n,).

        Returns
        -------
        ndarray or None
            Moments per width (N) along warp and weft, shape (n, 2).

        Examples
        --------
        >>> bending = {"curvature": [0, 10, 30], "moment": [0, 0.02, 0.04]}
        >>> material = {"mass": 0.3, "bending_rigidity_warp": bending, "bending_rigidity_weft": 1e-3}
        >>> ply = plydrape.Ply(grippers=[4, 2], cell=[0.1, 0.1], material=material)
        >>> ply.material.moment([0, 20])
        array([[0.  , 0.  ],
               [0.03, 0.02]])
        """
    @property
    def name(self, /) -> str:
        """
        Name for reports.
        """
    @property
    def scatter(self, /) -> dict[str, float | dict[str, float]]:
        """
        How much its properties scatter between specimens: standard deviations as shares of their values, by the keys of a
        material file. That of the shear curve may be a factor f, a dict {"factor": f}: from 1/f to f times the value. Empty where
        nothing is said.

        Examples
        --------
        >>> scatter = {"mass": 0.02, "shear_curve": {"factor": 2}}
        >>> material = {"mass": 0.3, "bending_rigidity_warp": 1e-3, "bending_rigidity_weft": 1e-3}
        >>> ply = plydrape.Ply(grippers=[4, 2], cell=[0.1, 0.1], material={**material, "scatter": scatter})
        >>> ply.material.scatter
        {'mass': 0.02, 'shear_curve': {'factor': 2.0}}
        """
    def shear_force(self, /, angles: ArrayLike) -> NDArray[float64] | None:
        """
        Shear force per length (N/m) at shear angles (rad), shape (n,); None if the material has no shear curve.

        Parameters
        ----------
        angles : array_like
            Shear angles (rad), of any shape.

        Returns
        -------
        ndarray or None
            Shear forces per length (N/m), of the same shape.

        Examples
        --------
        >>> curve = {"angle": [0, "20 deg"], "force": [0, "10 N/m"]}
        >>> material = {"mass": 0.3, "flexural_rigidity": 9e-6, "shear_curve": curve}
        >>> ply = plydrape.Ply(grippers=[4, 2], cell=[0.1, 0.1], material=material)
        >>> ply.material.shear_force(np.deg2rad([0, 10, 20]))
        array([ 0.,  5., 10.])
        """
    @property
    def shear_rate(self, /) -> dict[str, float] | None:
        """
        What resin adds to the shear force while the ply is sheared in real time, where it is known: `stiffness` against fast shear
        (N/m per rad), `relaxation` (s) at the `temperature` of the ply (K).
        """
    @staticmethod
    def shipped(name: str) -> Material:
        """
        A material that comes with plydrape, see `materials`.

        Parameters
        ----------
        name : str
            Its name.

        Returns
        -------
        Material
            The material.

        Raises
        ------
        ValueError
            If there is no such name.

        Examples
        --------
        >>> plydrape.Material.shipped("krogh2018").name
        'krogh2018'
        """
    @property
    def source(self, /) -> str:
        """
        Where its numbers come from.
        """
    def tension(self, /, strains: ArrayLike) -> NDArray[float64] | None:
        """
        Tension per width (N/m) at strains, shape (n,); None if the material does not say it.

        Parameters
        ----------
        strains : array_like
            Strains, of any shape.

        Returns
        -------
        ndarray or None
            Tensions per width (N/m), of the same shape.

        Examples
        --------
        >>> plydrape.Material.shipped("krogh2018").tension(np.array([0, 0.001]))
        array([   0., 1000.])
        """
    @staticmethod
    def text(name: str) -> str:
        """
        The file of a material that comes with plydrape: TOML.

        Parameters
        ----------
        name : str
            Its name.

        Returns
        -------
        str
            The text of the file.

        Raises
        ------
        ValueError
            If there is no such name.

        Examples
        --------
        >>> "source" in plydrape.Material.text("krogh2018")
        True
        """

@final
class Measure:
    """
    Something that is measured of a drape: what it is called, in which unit, and how a limit bounds it.

    Examples
    --------
    >>> shares = [measure for measure in plydrape.measures() if measure.sense == "at-least"]
    >>> [(measure.label, measure.shown) for measure in shares]
    [('contact share', '%'), ('gripper distance', 'mm'), ('clearance', 'mm'), ('table gap', 'mm'), ('joint margin', '°'), ('distance from a singularity', '1')]
    """
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __repr__(self, /) -> str: ...
    @property
    def factor(self, /) -> float:
        """
        From a value in `unit` to the same in `shown`.
        """
    @property
    def key(self, /) -> str:
        """
        Key in `Result.measures` and in each step of a result, the unit at its end where it has one.
        """
    @property
    def label(self, /) -> str:
        """
        What it is called in tables and charts.
        """
    @property
    def name(self, /) -> str:
        """
        Name of its limit: its key in `limits` of a scene that sets one, and its name in `Result.limits`.
        """
    @property
    def scope(self, /) -> str:
        """
        When it counts: "every-step"; the last step alone, "end"; "time" only of a motion with times; "whole" of a
        motion or plan in one, so that no step has it.
        """
    @property
    def sense(self, /) -> str:
        """
        Which way a limit bounds it: "at-most" or "at-least".
        """
    @property
    def shown(self, /) -> str:
        """
        Unit that it is shown in, which is that of its limit in `Result.limits`: "mm", "°", "N", "%".
        """
    @property
    def unit(self, /) -> str:
        """
        Unit of its values in `Result.measures`: "mm", "deg", "N"; "1" of ratios and shares.
        """

@final
class Mold:
    """
    What a ply is laid on. Scenes have one; triangles of your own make one.

    Examples
    --------
    >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
    >>> mold.kind
    'sphere'
    """
    def __repr__(self, /) -> str: ...
    def closest_points(self, /, points: ArrayLike) -> ClosestPoints:
        """
        What lies closest to points (m), shape (n, 3).

        Parameters
        ----------
        points : array_like
            Points (m), shape (n, 3) or (…, 3).

        Returns
        -------
        ClosestPoints
            What is closest to each, in arrays with the same axes.

        Examples
        --------
        >>> mold = plydrape.Scene.read("examples/03_tilted_plane/scene.toml").mold
        >>> closest = mold.closest_points([[0, 0, 1]])
        >>> closest.points.shape, closest.distances.shape
        ((1, 3), (1,))
        """
    def heights(self, /, places: ArrayLike) -> NDArray[float64]:
        """
        Height of its highest point over places of the plan (m), nan where there is none.

        Parameters
        ----------
        places : array_like
            x and y (m), shape (n, 2) or (…, 2).

        Returns
        -------
        ndarray
            Heights (m), shape (n,) or (…).

        Examples
        --------
        >>> mold = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml").mold
        >>> mold.heights([[0, 0], [0.3, 0.1]])
        array([0., 0.])
        """
    @property
    def kind(self, /) -> str:
        """
        Kind: "plane", "cylinder", "sphere", "torus", "graph" or "mesh"; "wavy" where the errors
        of a scene laid waves on it; "layered" where plies of a book lie on it.
        """
    def mesh(self, /) -> tuple[NDArray[float64], NDArray[uint32]] | None:
        """
        The triangles that a mold of kind "mesh" is made of; None of another kind.

        Returns
        -------
        tuple[ndarray, ndarray] or None
            Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).

        Examples
        --------
        >>> mold = plydrape.Mold.triangles([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> points, triangles = mold.mesh()
        >>> points.shape, triangles
        ((3, 3), array([[0, 1, 2]], dtype=uint32))
        """
    def patch(
        self,
        /,
        low: typing.Sequence[float | str],
        high: typing.Sequence[float | str],
        *,
        most: SupportsIndex = 20000,
    ) -> tuple[NDArray[float64], NDArray[uint32]]:
        """
        The mold over a rectangle of the plan as triangles.

        Parameters
        ----------
        low : sequence of float or str
            Lowest x and y (m, or texts with a unit).
        high : sequence of float or str
            Highest x and y (m, or texts with a unit).
        most : int, default 20000
            About how many triangles at most; a mold that is no mesh is sampled in a million at most.

        Returns
        -------
        tuple of ndarray, ndarray
            Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).

        Examples
        --------
        >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
        >>> points, triangles = mold.patch((-0.1, -0.1), (0.1, 0.1), most=200)
        >>> points.shape[1], triangles.shape[1], len(triangles) <= 200
        (3, 3, True)
        """
    def to_pyvista(
        self,
        /,
        low: typing.Sequence[float | str],
        high: typing.Sequence[float | str],
        *,
        most: SupportsIndex = 20000,
    ) -> pyvista.PolyData:
        """
        Surface as a mesh of PyVista, over a rectangle of the plan. Needs PyVista.

        Parameters
        ----------
        low : sequence of float or str
            Lowest x and y (m, or texts with a unit).
        high : sequence of float or str
            Highest x and y (m, or texts with a unit).
        most : int, default 20000
            About how many triangles at most; a mold that is no mesh is sampled in a million at most.

        Returns
        -------
        pyvista.PolyData
            The triangles.

        Examples
        --------
        >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
        >>> mold.to_pyvista(("-10 cm", "-10 cm"), ("10 cm", "10 cm"), most=200).n_cells <= 200
        True
        """
    @staticmethod
    def triangles(points: ArrayLike, triangles: ArrayLike) -> Mold:
        """
        A mold of triangles, such as a mesher or a CAD reader makes them; vertices at one place are merged and
        triangles turned to one side.

        Parameters
        ----------
        points : array_like
            Corners (m), shape (n, 3).
        triangles : array_like
            Indices of each triangle's corners, shape (m, 3).

        Returns
        -------
        Mold
            The mold.

        Raises
        ------
        ValueError
            If the triangles are no mold: empty, without area, or not a surface.

        Examples
        --------
        >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> mold = plydrape.Mold.triangles(square, [[0, 1, 2], [0, 2, 3]])
        >>> mold.heights([[0.5, 0.25]])
        array([0.])
        """

@final
class Net:
    """
    The ideal drape: the fabric as a pin-jointed net on the mold.

    Examples
    --------
    >>> net = plydrape.Net.read("examples/hemisphere_net/scene.toml")
    >>> net.nodes.shape
    (24, 24, 3)
    """
    def __repr__(self, /) -> str: ...
    @property
    def largest_edge_error(self, /) -> float:
        """
        Largest error of a length between neighboring nodes (m).
        """
    @property
    def mesh(self, /) -> tuple[float, float]:
        """
        Fabric between neighboring nodes along u and v (m).
        """
    @property
    def missing(self, /) -> list[tuple[tuple[int, int], str]]:
        """
        Why each node of the ply without a place has none, those closest to the seed first: indices and reason.
        """
    @property
    def nodes(self, /) -> NDArray[float64]:
        """
        Places of the nodes (m), shape (along u, along v, 3); nan where a node has no place on the mold.
        """
    @property
    def on_ply(self, /) -> NDArray[bool_]:
        """
        Whether each node is on the ply, shape (along u, along v); the net of a ply that is cut covers the box around it.
        """
    @staticmethod
    def read(path: str | PathLike[str]) -> Net:
        """
        Lays the ply of a scene file on its mold, whether or not grippers could bring it there, as `plydrape net`
        does.

        Parameters
        ----------
        path : str or path
            The scene file.

        Returns
        -------
        Net
            The ideal drape.

        Raises
        ------
        SceneError
            If the file has no `[ply]`, `[mold]` and `[target]` that make sense.

        Examples
        --------
        >>> net = plydrape.Net.read("examples/hemisphere_net/scene.toml")
        >>> float(net.shear_deg.max().round(3))
        38.005
        """
    @property
    def shear_deg(self, /) -> NDArray[float64]:
        """
        Shear angle of each cell (°), shape (along u − 1, along v − 1); nan where a corner has no place, and in cells of which
        less than half is on the ply.
        """

@final
class Outcome:
    """
    The last step of a drape with its derivatives to where the grippers are in it.

    Fabric in contact by then is held: the derivatives are those of the outcome to the grippers' targets as
    long as a slightly different last step catches nothing more, and exact where the state is smooth.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> outcome = plydrape.outcome(scene)
    >>> worst = outcome.overstretch.argmax()
    >>> outcome.overstretch_jacobian[worst].shape
    (8, 3)
    """
    def __repr__(self, /) -> str: ...
    @property
    def forces(self, /) -> NDArray[float64]:
        """
        Horizontal force of each catenary (N), shape (catenaries,); nan where there is none.
        """
    @property
    def forces_jacobian(self, /) -> NDArray[float64]:
        """
        Derivatives to the grippers' positions (N/m), shape (catenaries, grippers, 3).
        """
    @property
    def overstretch(self, /) -> NDArray[float64]:
        """
        Taut path of each catenary's tightest free segment beyond its fabric (m), negative where it is slack, shape
        (catenaries,): straight where it hangs, along the mold where it lies.
        """
    @property
    def overstretch_jacobian(self, /) -> NDArray[float64]:
        """
        Derivatives to the grippers' positions, shape (catenaries, grippers, 3).
        """
    @property
    def result(self, /) -> Result:
        """
        The drape.
        """
    @property
    def shear(self, /) -> NDArray[float64]:
        """
        Shear angle of each cell (rad), shape (cells,), those along u first; nan where it does not shear.
        """
    @property
    def shear_jacobian(self, /) -> NDArray[float64]:
        """
        Derivatives to the grippers' positions (rad/m), shape (cells, grippers, 3).
        """
    @property
    def tilts(self, /) -> NDArray[float64]:
        """
        Angle between the ply's normal at each gripper and the vertical (rad), shape (grippers,).
        """
    @property
    def tilts_jacobian(self, /) -> NDArray[float64]:
        """
        Derivatives to the grippers' positions (rad/m), shape (grippers, grippers, 3); 0 at a level gripper.
        """

@final
class Plan:
    """
    A planned motion, and the drape along it.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> plan = plydrape.plan(scene, without_errors=True)
    >>> plan.accepted, plan.positions.shape[1:]
    (True, (8, 3))
    """
    def __repr__(self, /) -> str: ...
    @property
    def accepted(self, /) -> bool:
        """
        Whether every limit is kept, by the model that decides, and in enough cells of the sample where the scene has errors.
        """
    @property
    def checkpoint(self, /) -> str:
        """
        The checkpoint from which a later search continues: the text of plan.json.
        """
    @property
    def decisions(self, /) -> int:
        """
        How many of these drapes decided on a plan, with the mesh of the scene where the sheet decides; the others ranked
        candidates.
        """
    @property
    def duration(self, /) -> float:
        """
        How long the motion takes (s).
        """
    @property
    def evaluations(self, /) -> int:
        """
        Drapes that the search took; of the stepwise planner, steps.
        """
    @property
    def limited_by(self, /) -> list[dict[str, Any]]:
        """
        What limits the time of the motion, that of the longest time first.

        Each limit is a dict: its `name`, for how long it is the one that is nearest to its limit (`time_s`), and the `gripper` with
        which it is that for the longest as [i, j], None of the frame of a tool.
        """
    @property
    def method(self, /) -> str:
        """
        The planner: "path" or "stepwise".
        """
    def motion(self, /, times: ArrayLike) -> dict[str, NDArray[float64]]:
        """
        The grippers at any times of the motion.

        Parameters
        ----------
        times : array_like
            Times (s), shape (n,).

        Returns
        -------
        dict[str, ndarray]
            "positions", "velocities", "accelerations" and "jerks" (m, s), each of shape (n, grippers, 3).

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> plan = plydrape.plan(scene, without_errors=True)
        >>> motion = plan.motion(np.linspace(0, plan.duration, 101))
        >>> speeds = np.linalg.norm(motion["velocities"], axis=2)
        >>> bool(speeds.max() < 0.25), bool(speeds[[0, -1]].max() < 1e-9)
        (True, True)
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Planned positions of the grippers (m), shape (steps, grippers, 3): control points of the smooth motion.
        """
    @property
    def refused(self, /) -> int:
        """
        How many plans the sample of cells with errors refused in the search.
        """
    @property
    def result(self, /) -> Result:
        """
        The drape along the planned motion, with all limits judged.
        """
    @property
    def time_over(self, /) -> bool:
        """
        Whether the search ended because its time was over.
        """
    @property
    def times(self, /) -> NDArray[float64]:
        """
        Time of each planned step (s), shape (steps,).
        """
    @property
    def tried(self, /) -> list[dict[str, Any]]:
        """
        Of a plan that is not accepted, the changes of its scene that were tried, what helps most first: dicts with change, near (limit, kept and
        cells) and helps, as in result.json.
        """
    def write(self, /, folder: str | PathLike[str]) -> list[Path]:
        """
        Writes result.json, steps.csv, trajectory.csv, motion.csv, report.html, plan.json, and of a sheet sheet.npz, into a
        folder, all or none, and returns their paths.

        Parameters
        ----------
        folder : str or path
            The folder; it is made where there is none.

        Returns
        -------
        list of Path
            The paths of the files.

        Raises
        ------
        OutputError
            If that cannot be done; a file that plydrape did not write is never overwritten.

        Examples
        --------
        >>> import tempfile
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> plan = plydrape.plan(scene, without_errors=True)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     sorted(path.name for path in plan.write(folder))
        ['motion.csv', 'plan.json', 'report.html', 'result.json', ...]
        """

@final
class Ply:
    """
    A woven ply held by grippers: a rectangle held by an array of them, or, from a scene, as it is cut.

    Grippers are counted with i, along u, running fastest. Catenaries are counted: edges along u, edges along
    v, then two diagonals a cell, the one from `[i, j]` to `[i + 1, j + 1]` first.

    Parameters
    ----------
    grippers : sequence of int
        How many there are along u and v; `[n, 1]` is a strip.
    cell : sequence of float or str
        Fabric length between neighbors along u and v, in m or as str with a unit.
    material : str or dict
        Name of a shipped material, path of a .toml file, or a dict of its keys.
    warp : str, default "u"
        Grid direction of the warp, "u" or "v".
    base : str or path, optional
        Folder of a material file.

    Raises
    ------
    SceneError
        If a value makes no sense.

    Examples
    --------
    >>> ply = plydrape.Ply(grippers=[4, 2], cell=["100 mm", "100 mm"], material="krogh2018")
    >>> len(ply.catenaries)
    16
    """
    def __new__(
        cls,
        /,
        *,
        grippers: typing.Sequence[int],
        cell: typing.Sequence[float | str],
        material: str | dict[str, typing.Any],
        warp: str = "u",
        base: str | PathLike[str] = ...,
    ) -> Ply: ...
    def __repr__(self, /) -> str: ...
    @property
    def catenaries(self, /) -> NDArray[int64]:
        """
        Grippers at the ends of each catenary, shape (catenaries, 2).
        """
    @property
    def cell(self, /) -> tuple[float, float]:
        """
        Fabric length of a cell along u and v (m).
        """
    @property
    def grippers(self, /) -> tuple[int, int]:
        """
        Grippers along u and v; zeros where they are no whole array along the yarns.
        """
    @property
    def holes(self, /) -> list[NDArray[float64]]:
        """
        Holes of a ply that is cut, each as `outline`, clockwise.
        """
    @property
    def ids(self, /) -> NDArray[int64]:
        """
        Indices i, j of each gripper, which are its name in files and pages, shape (grippers, 2).
        """
    @property
    def lengths(self, /) -> NDArray[float64]:
        """
        Fabric length of each catenary of the flat ply (m), shape (catenaries,).
        """
    @property
    def material(self, /) -> Material:
        """
        What it is made of.
        """
    @property
    def outline(self, /) -> NDArray[float64] | None:
        """
        Outline of a ply that is cut, fabric coordinates (m), shape (points, 2), counterclockwise; None of one that ends at its
        grippers or a margin beyond them.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/13_cut_ply/scene.toml")
        >>> scene.ply.outline.shape, len(scene.ply.holes), len(scene.ply.places)
        ((5, 2), 1, 15)
        """
    @property
    def places(self, /) -> NDArray[float64]:
        """
        Fabric coordinates u, v of each gripper (m), shape (grippers, 2), in the order of all arrays of grippers.
        """
    @property
    def warp(self, /) -> str:
        """
        Grid direction of the warp: "u" or "v".
        """

@final
class Result:
    """
    A drape: the grippers, loads and measures of every step, and the verdict, by the model that decides.

    What is of one model alone is there wherever that has draped, whether it decides or was asked for beside by `also`: the states
    of the `sheet`, and of the catenaries `forces`, `slack_mm`, `contact`, `shear_deg`, `lines`, `contact_lines` and `surface`.
    Arrays are in m, N, s unless the name says otherwise. Grippers are counted with i running fastest, catenaries as in
    `Ply`. Steps count from 1, the start; −1 is the last.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> result.model, result.positions.shape, result.first_contact_step
    ('sheet', (30, 8, 3), 22)
    """
    def __repr__(self, /) -> str: ...
    @property
    def accepted(self, /) -> bool:
        """
        Whether every step was done and every limit holds, by the model that decides, and in enough cells of the sample, if there is
        one.
        """
    @property
    def also(self, /) -> Drape | None:
        """
        The drape by the model that does not decide, as it was asked for by `also`; None where it was not. It is shown and judges
        nothing.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> plydrape.simulate(scene).also is None
        True
        >>> beside = plydrape.simulate(scene, also="catenaries").also
        >>> beside.model, beside.first_contact_step
        ('catenaries', 26)
        """
    @property
    def cell(self, /) -> tuple[float, float]:
        """
        Fabric length of a cell along u and v (m).
        """
    @property
    def commanded(self, /) -> NDArray[float64]:
        """
        Where the robot holds the grippers (m), shape (steps, grippers, 3): their positions where their mounts are rigid.
        """
    @property
    def contact(self, /) -> NDArray[float64]:
        """
        Fabric length of each catenary that is in contact (m), shape (steps, catenaries).

        Raises
        ------
        ValueError
            As `forces`.
        """
    def contact_lines(self, /, step: SupportsIndex) -> list[NDArray[float64]]:
        """
        The lines in which the ply touches the mold in a step (m), one for each catenary that does, arrays of
        shape (n, 3).

        Parameters
        ----------
        step : int
            The step, from 1; −1 is the last.

        Returns
        -------
        list of ndarray
            An array of points (m), shape (n, 3), for each catenary that touches.

        Raises
        ------
        IndexError
            If there is no such step.
        ValueError
            As `forces`.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene, model="catenaries")
        >>> len(result.contact_lines(1)), len(result.contact_lines(26))
        (0, 3)
        """
    @property
    def converged(self, /) -> bool:
        """
        Whether every step was solved and the ply is at rest at the end, by the model that decides.
        """
    @property
    def events(self, /) -> list[dict[str, Any]]:
        """
        When the pads grip, press and let go, in the order of time; empty where they hold the ply from first to last.

        Each event is a dict: its `time` in the motion (s), its `kind` ("grip", "press" or "release"), and its `grippers` as
        [i, j]. The last release comes later than the last step where pads dwell.
        """
    def export(
        self,
        /,
        to: typing.Literal[
            "vtk",
            "inp",
            "ngsolve",
            "ros2",
            "rapid",
            "krl",
            "urscript",
            "abb",
            "kuka",
            "ur",
            "csv",
            "pattern",
            "boundary",
        ],
        folder: str | PathLike[str],
        *,
        even_if_rejected: bool = False,
        position_error: float | str | None = None,
        least_way: float | str | None = None,
        least_time: float | str | None = None,
        large: bool = False,
        tf: bool = False,
        mesh: float | str | None = None,
        tension: float | str | None = None,
        templates: typing.Sequence[str | PathLike[str]] = ...,
    ) -> list[Path]:
        """
        Writes files for another program or a machine into a folder, all or none, and returns their paths.

        Parameters
        ----------
        to : {"vtk", "inp", "ngsolve", "ros2", "rapid", "krl", "urscript", "csv", "pattern", "boundary"}
            One of "vtk", "inp", "ngsolve", "ros2", "rapid", "krl", "urscript", "csv", "pattern" or "boundary"; "abb", "kuka" and "ur"
            mean "rapid", "krl" and "urscript".
        folder : str or path
            Where they go; other files there stay.
        even_if_rejected : bool, default False
            Write what drives a machine ("ros2", "rapid", "krl", "urscript" and "csv") although the
            result is not accepted; the files say so in their heads.
        position_error : float or str, optional
            How far what a robot passes between its points may be from the motion (m); 0.1 mm unless given.
        least_way, least_time : float or str, optional
            Least way (m) and time (s) between two points of a robot, whatever error that leaves; 1 mm and 0.1 s
            unless given.
        large : bool, default False
            Write what drives a machine also of a motion of more than ten minutes, or with samples of more than 50 MB.
        tf : bool, default False
            Write the frames over time (``/tf``) into the bag of "ros2".
        mesh : float or str, optional
            Largest side of the quads of "ngsolve" (m); a quarter of the distance of neighboring
            grippers unless given.
        tension : float or str, optional
            Tension stiffness per width of "inp" and "ngsolve" (N/m); 2e4 N/m unless given.
        templates : sequence of str or path, optional
            Files of templates in place of the shipped ones, for "rapid", "krl" and "urscript".

        Returns
        -------
        list of Path
            The paths of the files.

        Raises
        ------
        OutputError
            If that cannot be done.
        ValueError
            If there is no such format.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     sorted(path.name for path in result.export("csv", folder))
        ['motion_wide.csv', 'steps.csv', 'trajectory.csv']
        """
    @property
    def first_contact_step(self, /) -> int | None:
        """
        First step in which the ply touches the mold, by the model that decides; None if it does not.
        """
    @property
    def forces(self, /) -> NDArray[float64]:
        """
        Horizontal force of each catenary (N), shape (steps, catenaries): of its free segment that pulls or pushes most; of
        a stretched diagonal its shear force. nan where the model gives none.

        Raises
        ------
        ValueError
            If no catenaries were draped, as the sheet decides and `also` did not ask for them.
        """
    @property
    def grid(self, /) -> tuple[int, int]:
        """
        Grippers along u and v; zeros where they are no whole array along the yarns.
        """
    def html(self, /) -> str:
        """
        The page of `plydrape report`: one HTML file for any browser.

        Returns
        -------
        str
            The text of the page.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> result.html()[:15]
        '<!doctype html>'
        """
    @property
    def limits(self, /) -> Limits:
        """
        Every limit, judged by the model that decides, by its name.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> tilt = plydrape.simulate(scene).limits["tilt"]
        >>> round(tilt.value, 1), tilt.limit, tilt.unit, tilt.step, tilt.kept
        (28.6, 40.0, '°', 9, True)
        """
    def lines(self, /, step: SupportsIndex) -> list[NDArray[float64]]:
        """
        Each catenary of a step as a line from gripper to gripper (m), arrays of shape (n, 3).

        Parameters
        ----------
        step : int
            The step, from 1; −1 is the last.

        Returns
        -------
        list of ndarray
            An array of points (m), shape (n, 3), for each catenary.

        Raises
        ------
        IndexError
            If there is no such step.
        ValueError
            As `forces`.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene, model="catenaries")
        >>> len(result.lines(-1)), result.lines(-1)[0].shape[1]
        (16, 3)
        """
    @property
    def loads(self, /) -> NDArray[float64]:
        """
        Force of the ply on each gripper (N), shape (steps, grippers, 3).
        """
    @property
    def measures(self, /) -> dict[str, NDArray[float64]]:
        """
        The worst value of every measure of the model in each step, by name, each of shape (steps,); nan where it has no meaning in
        a step. The unit is part of the name, ratios have none. A measure that the model does not evaluate is not there.
        """
    @property
    def model(self, /) -> str:
        """
        The model that decides: "sheet" or "catenaries".
        """
    @property
    def mold(self, /) -> Mold | None:
        """
        Mold, if any.
        """
    def mold_surface(
        self, /, *, most: SupportsIndex = 20000
    ) -> tuple[NDArray[float64], NDArray[uint32]] | None:
        """
        The mold under all steps and the target in about `most` triangles: points (m), shape (n, 3), and corners,
        shape (m, 3). None without a mold there.

        Parameters
        ----------
        most : int, default 20000
            About how many triangles at most; a mold that is no mesh is sampled in a million at most.

        Returns
        -------
        tuple[ndarray, ndarray] or None
            Points (m), shape (n, 3), and the indices of each triangle's corners, shape (m, 3).

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> points, triangles = result.mold_surface(most=100)
        >>> points.shape[1], len(triangles) <= 100
        (3, True)
        """
    @property
    def net(self, /) -> Net | None:
        """
        The ideal drape, where it is known.
        """
    @staticmethod
    def parse(text: str) -> Result:
        """
        Reads the text of a result.json.

        Parameters
        ----------
        text : str
            The text.

        Returns
        -------
        Result
            The result.

        Raises
        ------
        ResultError
            As `read`.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> plydrape.Result.parse(result.to_json()).accepted
        True
        """
    def plot(
        self,
        /,
        kind: typing.Literal["steps", "measures", "shear", "sheet"] = "steps",
        **options: typing.Any,
    ) -> matplotlib.figure.Figure:
        """
        A figure for a paper, by Matplotlib: see `plydrape.plot`. Needs Matplotlib.

        Parameters
        ----------
        kind : {"steps", "measures", "shear", "sheet"}, default "steps"
            "steps", "measures", "shear" or "sheet".
        **options
            Those of `steps`, `measures`, `shear_map` or `sheet` in `plydrape.plot`.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> figure = result.plot("measures")
        """
    @property
    def ply(self, /) -> Ply:
        """
        The ply that was draped.
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Positions of the grippers (m), shape (steps, grippers, 3): where they hold the fabric.
        """
    @property
    def program(self, /) -> str:
        """
        Name and version of the program that made it.
        """
    @property
    def quaternions(self, /) -> NDArray[float64]:
        """
        Orientations of the grippers as quaternions x, y, z, w, shape (steps, grippers, 4): z along the ply's normal, x along
        u.
        """
    @staticmethod
    def read(path: str | PathLike[str]) -> Result:
        """
        Reads a result.json.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Result
            The result.

        Raises
        ------
        ResultError
            If it cannot be read, or is not, to the last byte, what this version writes. Where there is no such file, it is a
            FileNotFoundError too.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder) / "result.json"
        ...     _ = path.write_text(result.to_json())
        ...     plydrape.Result.read(path).title == result.title
        True
        """
    def replan(
        self,
        /,
        *,
        offset: dict[str, float | str | typing.Sequence[float | str]] | None = None,
        points: numpy.typing.ArrayLike
        | typing.Sequence[tuple[typing.Sequence[float | str], typing.Sequence[float | str]]]
        | None = None,
        tolerance: float | str | None = None,
        far: bool = False,
    ) -> Result:
        """
        The result of this plan for a ply that does not lie where it was planned to be picked up.

        The grippers start where the ply lies, the offset is taken out in the air, and the landing is the planned one. What the motion
        changes is judged again, and the motion is slower where it would be too fast.

        Parameters
        ----------
        offset : dict, optional
            The shift x and y (m, or texts with a unit), the yaw (rad, or a text), and the point (x, y) that the ply is turned
            about, the middle of the grippers at the start unless given.
        points : array or sequence of Any, optional
            Instead of it, pairs of where points were planned and where they were seen, two or more, each (x, y) in m: an array of the
            shape (n, 2, 2), or a list of pairs, whose places may be texts with units.
        tolerance : float or str, optional
            How far a point may be from where the others put it (m); as far as points of the ply may land from their places unless
            given.
        far : bool
            Whether the ply does lie more than 50 mm or 10° from where it was planned, which is refused otherwise.

        Returns
        -------
        Result
            The result along the motion that was changed.

        Raises
        ------
        SceneError
            If offset or points cannot be read.
        PlanError
            If the result was not planned, or the offset cannot be taken out before the ply meets the mold.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> plan = plydrape.plan(scene, without_errors=True)
        >>> moved = plan.result.replan(offset=dict(x="3 mm", y="-1.5 mm", yaw="0.8 deg"))
        >>> moved.accepted, bool((moved.positions[-1] == plan.result.positions[-1]).all())
        (True, True)
        """
    def report(self, /, path: str | PathLike[str]) -> Path:
        """
        Writes the page into a file and returns its path.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Path
            The same path.

        Raises
        ------
        OutputError
            If that cannot be done; a file that plydrape did not write is never overwritten.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     result.report(pathlib.Path(folder) / "page.html").name
        'page.html'
        """
    @property
    def sample(self, /) -> Sample | None:
        """
        The verdict over a sample of cells with the errors of the scene; None where the scene has none.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> plydrape.simulate(scene).sample is None
        True
        """
    @property
    def scene_text(self, /) -> str | None:
        """
        The text of its scene, where it had one.
        """
    @property
    def shear_deg(self, /) -> NDArray[float64]:
        """
        Shear angle of each cell between catenaries (°), shape (steps, cells along v, cells along u), or (steps, cells) where the
        cups are no whole array along the yarns; 0 where no bias line shears.

        Raises
        ------
        ValueError
            As `forces`.
        """
    @property
    def sheet(self, /) -> Sheet | None:
        """
        The states of the whole ply as a sheet, where it was draped as one; else None.

        Raises
        ------
        ResultError
            If sheet.npz is not beside the result that was read, or was changed.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> plydrape.simulate(scene, model="catenaries").sheet is None
        True
        >>> plydrape.simulate(scene).sheet
        <plydrape.Sheet of 341 nodes, 30 states>
        """
    def show(self, /, *, height: SupportsIndex = 640) -> plydrape.notebook.Page:
        """
        The page of the result inside a notebook.

        Parameters
        ----------
        height : int, default 640
            Height of the frame (pixels).

        Returns
        -------
        Page
            The page; a notebook shows it as the last value of a cell.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> page = result.show(height=400)
        """
    @property
    def slack_mm(self, /) -> NDArray[float64]:
        """
        Slack of each catenary (mm), shape (steps, catenaries): all of its free segments.

        Raises
        ------
        ValueError
            As `forces`.
        """
    @property
    def summary(self, /) -> dict[str, Any]:
        """
        The outcome by the model that decides: the `summary` of result.json.
        """
    def surface(self, /, step: SupportsIndex, *, intervals: SupportsIndex = 8) -> Surface:
        """
        The ply between the catenaries of a step as a surface with this many intervals along each side of a cell.

        Parameters
        ----------
        step : int
            The step, from 1; −1 is the last.
        intervals : int, default 8
            Intervals along each side of a cell, 1 to 1000.

        Returns
        -------
        Surface
            The surface.

        Raises
        ------
        IndexError
            If there is no such step.
        ValueError
            As `forces`, or if there are too many intervals.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene, model="catenaries")
        >>> surface = result.surface(1, intervals=4)
        >>> surface.size, surface.points.shape, surface.triangles.shape
        ((13, 5), (65, 3), (96, 3))
        """
    @property
    def tilts_deg(self, /) -> NDArray[float64]:
        """
        Angles between the ply's normal at the grippers and their stems, which are upright unless a tool turns them (°), shape
        (steps, grippers).
        """
    @property
    def times(self, /) -> NDArray[float64]:
        """
        Time of each step (s), shape (steps,).
        """
    @property
    def title(self, /) -> str:
        """
        Title of its scene.
        """
    def to_dict(self, /) -> dict[str, Any]:
        """
        The whole result.json as dicts and lists.

        Returns
        -------
        dict
            The keys of result.json.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> sorted(result.to_dict())
        ['catenaries', 'checksum', 'format', 'plan', 'program', 'scene', 'steps', 'summary', 'version']
        """
    def to_json(self, /) -> str:
        """
        The text of result.json, with its check sum.

        Returns
        -------
        str
            The text.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> result.to_json()[:28]
        '{"format":"plydrape-result",'
        """
    def to_pandas(
        self, /, table: typing.Literal["measures", "grippers", "catenaries", "limits"] = "measures"
    ) -> pandas.DataFrame:
        """
        A tidy table of numbers: one row for each thing in each step. Needs pandas.

        Column names end in the unit where it is not SI, as the names of the properties do.

        Parameters
        ----------
        table : {"measures", "grippers", "catenaries", "limits"}, default "measures"
            "measures", one row a step; "grippers", one row a step and gripper; "limits", one row a limit, all of the model that
            decides; "catenaries", one row a step and catenary, where catenaries were draped.

        Returns
        -------
        pandas.DataFrame
            The table, with a plain index.

        Raises
        ------
        ExtraError
            If pandas is not installed.
        ValueError
            If there is no such table, or no catenaries were draped for theirs.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> frame = plydrape.simulate(scene).to_pandas("grippers")
        >>> list(frame.columns[:5])
        ['step', 'time', 'gripper', 'i', 'j']
        """
    def to_pyvista(self, /, step: SupportsIndex = ...) -> pyvista.MultiBlock:
        """
        A step as meshes of PyVista with their numbers, in m. Needs PyVista.

        Parameters
        ----------
        step : int, default -1
            Which step; −1 is the last.

        Returns
        -------
        pyvista.MultiBlock
            The blocks "mold" and "grippers", "ply" and "catenaries" where catenaries were draped, "sheet" where the sheet was, as far
            as there are such.

        Raises
        ------
        ExtraError
            If PyVista is not installed.
        ValueError
            If there is no such step.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> blocks = plydrape.simulate(scene).to_pyvista()
        >>> blocks.keys()
        ['mold', 'grippers', 'sheet']
        >>> blocks["sheet"].array_names
        ['height_mm', 'contact', 'landing_step', 'shear_deg']
        """
    def to_xarray(self, /) -> xarray.Dataset:
        """
        Everything over the steps as one labeled data set. Needs xarray.

        The dimensions are `step`, `u` and `v` of the grippers (or `gripper` where they are no whole array) and `xyz`, and where
        catenaries were draped `catenary`, `cell_u` and `cell_v`; every variable has its `units` and `long_name`. Names and units are
        those of the properties.

        Returns
        -------
        xarray.Dataset
            The data set.

        Raises
        ------
        ExtraError
            If xarray is not installed.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> data = plydrape.simulate(scene).to_xarray()
        >>> data["positions"].dims, data["positions"].attrs["units"]
        (('step', 'u', 'v', 'xyz'), 'm')
        """
    @property
    def tolerance(self, /) -> dict[str, Any] | None:
        """
        What the motion tolerates: a dict with gripper_mm (standard deviation of each gripper's position along each axis),
        gripper_at_least (whether it is the largest that was tried), shear and mass (the least and the largest multiple of the ply's shear
        stiffness and mass; no shear where the model knows none) and tried (cells by which each error was tried). None where it was not
        asked for.
        """
    @property
    def verdict(self, /) -> str:
        """
        The verdict in words, with the world in which it was reached: "accepted", by a sample of cells with errors; "accepted without
        errors"; "accepted in an ideal cell, without errors", where mounts are rigid too; or "not accepted". Of catenaries it names what
        they do not see of the scene: fabric beyond the outer grippers, and holes of the mold between their lines.
        """
    def write(self, /, folder: str | PathLike[str]) -> list[Path]:
        """
        Writes result.json, steps.csv, trajectory.csv, report.html, of a plan motion.csv, and of a sheet
        sheet.npz, into a folder, all or none, and returns their paths.

        Parameters
        ----------
        folder : str or path
            The folder; it is made where there is none.

        Returns
        -------
        list of Path
            The paths of the files.

        Raises
        ------
        OutputError
            If that cannot be done; a file that plydrape did not write is never overwritten.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     sorted(path.name for path in result.write(folder))
        ['report.html', 'result.json', 'steps.csv', 'trajectory.csv']
        """

@final
class Sample:
    """
    The verdict over a sample of cells, each with errors of its own: complete drapes along the same motion, up to the cell that decides.

    Examples
    --------
    >>> tables = dict(
    ...     ply=dict(grippers=[2, 2], cell=["100 mm", "100 mm"], material="krogh2018"),
    ...     grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"),
    ...     model=dict(kind="catenaries"),
    ... )
    >>> errors = dict(samples=8, gripper=dict(position=dict(bound="0.1 mm")))
    >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=errors)
    >>> plydrape.simulate(scene).sample
    <plydrape.Sample of 8 cells, 8 accepted, accepted>
    """
    def __len__(self, /) -> int: ...
    def __repr__(self, /) -> str: ...
    @property
    def accepted(self, /) -> int:
        """
        How many cells keep every limit.
        """
    @property
    def confidence(self, /) -> float:
        """
        Confidence, from 0 to 1, that the share of all possible cells keeps every limit if `ok`, and that fewer do if not.
        """
    @property
    def height_mm(self, /) -> float | None:
        """
        The largest height (mm) that the share of the cells keeps which must keep the limits; None of catenaries, or where
        fewer drapes have an end.
        """
    @property
    def heights_mm(self, /) -> NDArray[float64]:
        """
        The largest height of each cell's sheet at the end (mm), shape (cells,); nan where its drape has no end, and of
        catenaries.
        """
    @property
    def highest(self, /) -> dict[str, Any] | None:
        """
        Where the sheet is highest by the height that the share of the cells keeps there: a dict with height_mm, uv_mm, line and
        gripper. None of catenaries.
        """
    @property
    def kept(self, /) -> NDArray[bool_]:
        """
        Whether each cell keeps every limit, shape (cells,).
        """
    @property
    def limits(self, /) -> Limits:
        """
        Every limit, judged by the value that the share of the cells keeps, by its name, as in `Result.limits`.
        """
    @property
    def needed(self, /) -> int:
        """
        How many cells of at most `errors.samples` must keep every limit.
        """
    @property
    def ok(self, /) -> bool:
        """
        Whether enough of them do, or as many without a failure as give 95 % confidence.
        """
    @property
    def ratios(self, /) -> NDArray[float64]:
        """
        The largest ratio of a measure to its limit in each cell, shape (cells,): above 1 it is not kept.
        """
    @property
    def spread_mm(self, /) -> NDArray[float64]:
        """
        The height at each node of the sheet that the share of the cells keeps (mm), shape (nodes,), in four digits; empty of
        catenaries.
        """

@final
class Scene:
    """
    A checked scene: the ply, its grippers, the mold, and where all of it goes.

    Every argument is a dict with the keys of the table of that name in a scene file; plain numbers are in SI
    units, a str carries its unit. Arrays may stand for lists. `mold` may also be a `Mold`.

    Parameters
    ----------
    ply : dict
        What hangs between the grippers: `grippers`, `cell`, `material`, `warp`, `overhang`.
    mold : dict or Mold, optional
        What the ply is laid on; also `points` and `triangles` of a mesh, as arrays.
    grippers : dict, optional
        Where the grippers start.
    target : dict, optional
        Where the ply shall end.
    motion : dict, optional
        How the grippers move; also `times` (s), shape (steps,), and `positions` (m), as `with_motion` takes them.
    model : dict, optional
        Which model drapes and decides, and its rules.
    sheet : dict, optional
        How the ply is divided and followed as a sheet.
    contact : dict, optional
        How contact is found.
    limits : dict, optional
        What an accepted drape keeps to.
    plan : dict, optional
        How a motion is planned.
    cell : dict, optional
        What holds the ply and how far it may be off, where `grippers` and `errors` do not say so.
    errors : dict, optional
        How far a real cell may be from the scene.
    robot : dict, optional
        The arm that carries the tool.
    pick_up : dict, optional
        How the ply is picked up from a table.
    release : dict, optional
        When the pads let go of the ply.
    tool : dict, optional
        What carries the grippers.
    bodies : sequence of dict, optional
        What moves with grippers and robot, a list of dicts.
    obstacles : sequence of dict, optional
        What stands in the cell, a list of dicts.
    title : str, optional
        Name for reports.
    base : str or path, optional
        Folder of files that the tables name.

    Raises
    ------
    SceneError
        If the scene makes no sense; it names the place, the fault and a remedy.

    Examples
    --------
    >>> scene = plydrape.Scene(
    ...     ply=dict(grippers=[4, 2], cell=[0.1, 0.1], material="krogh2018"),
    ...     mold=dict(kind="plane"),
    ...     grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"),
    ...     target=dict(origin=[0, 0], direction="20 deg", shear="20 deg"),
    ... )
    >>> scene.positions.shape
    (30, 8, 3)
    """
    def __new__(
        cls,
        /,
        *,
        ply: dict[str, typing.Any],
        mold: dict[str, typing.Any] | Mold | None = None,
        grippers: dict[str, typing.Any] | None = None,
        target: dict[str, typing.Any] | None = None,
        motion: dict[str, typing.Any] | None = None,
        model: dict[str, typing.Any] | None = None,
        sheet: dict[str, typing.Any] | None = None,
        contact: dict[str, typing.Any] | None = None,
        limits: dict[str, typing.Any] | None = None,
        plan: dict[str, typing.Any] | None = None,
        cell: dict[str, typing.Any] | None = None,
        errors: dict[str, typing.Any] | None = None,
        robot: dict[str, typing.Any] | None = None,
        pick_up: dict[str, typing.Any] | None = None,
        release: dict[str, typing.Any] | None = None,
        tool: dict[str, typing.Any] | None = None,
        bodies: typing.Sequence[dict[str, typing.Any]] | None = None,
        obstacles: typing.Sequence[dict[str, typing.Any]] | None = None,
        title: str | None = None,
        base: str | PathLike[str] = ...,
    ) -> Scene: ...
    def __repr__(self, /) -> str: ...
    def _tables(self, /) -> dict[str, typing.Any]:
        """
        The tables of the scene as they were given; a mold or a motion that was given beside them as objects.
        """
    def draw(
        self, /, sample: SupportsIndex, factor: SupportsFloat | SupportsIndex = 1.0
    ) -> dict[str, Any]:
        """
        The error of every quantity in one sample of the scene's `errors`, in SI units.

        It depends on the seed of the errors and the number of the sample only.

        Parameters
        ----------
        sample : int
            Its number, from 0.
        factor : float, default 1.0
            How many times as large all errors are.

        Returns
        -------
        dict
            The errors by the names of the tables of `errors`.

        Raises
        ------
        ValueError
            If the scene has no errors, or the factor is not finite.

        Examples
        --------
        >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
        >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
        >>> frame = dict(position=dict(bound="1 mm"))
        >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(frame=frame))
        >>> all(abs(shift) <= 0.001 for shift in scene.draw(0)["frame"]["shift"])
        True
        """
    @property
    def errors(self, /) -> dict[str, Any] | None:
        """
        How far a real cell may be from the scene, where it says so: its `[errors]` in SI units, each term one of
        `{"deviation": …}`, `{"bound": …}` and, of the ply, `{"factor": …}`.

        Examples
        --------
        >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
        >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
        >>> gripper = dict(position=dict(deviation="0.1 mm"))
        >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(gripper=gripper))
        >>> scene.errors["gripper"]["position"]
        {'deviation': 0.0001}
        """
    @staticmethod
    def from_dict(tables: typing.Mapping[str, typing.Any]) -> Scene:
        """
        The scene that `to_dict` wrote.

        Parameters
        ----------
        tables : dict
            Keyword arguments of a scene.

        Returns
        -------
        Scene
            The scene, checked as any other.

        Raises
        ------
        SceneError
            If it makes no sense.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
        >>> plydrape.Scene.from_dict(scene.to_dict()) == scene
        True
        """
    @property
    def mold(self, /) -> Mold | None:
        """
        What it is laid on, if anything.
        """
    @property
    def net(self, /) -> Net | None:
        """
        The ideal drape that its target is taken from, where there is one.
        """
    @staticmethod
    def parse(text: str, *, base: str | PathLike[str] = ..., name: str = "scene.toml") -> Scene:
        """
        Reads and checks the text of a scene file.

        Parameters
        ----------
        text : str
            TOML, see the guide and docs/scene.schema.json.
        base : str or path, optional
            Folder of the files that it names.
        name : str, default "scene.toml"
            What it is called in errors.

        Returns
        -------
        Scene
            The scene.

        Raises
        ------
        SceneError
            If it makes no sense.

        Examples
        --------
        >>> plydrape.Scene.parse(plydrape.Scene.template()).mold.kind
        'plane'
        """
    def placed(self, /) -> Scene:
        """
        This scene where the arm of its robot follows the motion best.

        Places of the scene in the robot's world are tried, on a grid in units of the arm's reach, with the motion that the scene has; the bodies of the
        arm stay clear of mold and obstacles.

        Returns
        -------
        Scene
            The same scene with another `world` in its `tool`.

        Raises
        ------
        ValueError
            If no arm is known, or it follows from no place.

        Examples
        --------
        >>> tables = dict(ply=dict(grippers=[2, 2], cell=[0.1, 0.1], material="prepreg_warm"))
        >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
        >>> tables |= dict(motion=dict(kind="hold"), tool=dict(world=dict(position=[9, 0, 0])))
        >>> tables |= dict(model=dict(kind="catenaries"))
        >>> scene = plydrape.Scene(**tables, robot=dict(arm="ur20"))
        >>> [plydrape.simulate(at).limits["arm_miss"].kept for at in (scene, scene.placed())]
        [False, True]
        """
    @property
    def ply(self, /) -> Ply:
        """
        What hangs between the grippers.
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Positions of the grippers in each step (m), shape (steps, grippers, 3), i running fastest.
        """
    @staticmethod
    def read(path: str | PathLike[str]) -> Scene:
        """
        Reads and checks a scene file; files it names are relative to its folder.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Scene
            The scene.

        Raises
        ------
        SceneError
            If it cannot be read or makes no sense. Where there is no such file, or none that may be read, it is a FileNotFoundError or
            PermissionError too.

        Examples
        --------
        >>> plydrape.Scene.read("examples/02_hanging_strip/scene.toml").ply.grippers
        (2, 1)
        """
    @staticmethod
    def read_book(path: str | PathLike[str]) -> list[tuple[str, Scene]]:
        """
        Reads and checks a plybook: the name and the scene of each ply, in the order in which they are laid. The mold of a scene has
        the plies on it that the ply lies on.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        list of tuple[str, Scene]
            Name and scene of each ply.

        Raises
        ------
        SceneError
            If it cannot be read or makes no sense. Where there is no such file, or none that may be read, it is a FileNotFoundError or
            PermissionError too.

        Examples
        --------
        >>> plies = plydrape.Scene.read_book("examples/15_plybook/plies.toml")
        >>> [(name, scene.mold.kind) for name, scene in plies][:2]
        [('base 0', 'mesh'), ('turned 30', 'layered')]
        """
    def replace(self, /, **changes: typing.Any) -> Scene:
        """
        This scene with other values: keyword arguments as those of a scene, of which only those that change are needed.

        A dict is merged into the table of that name, key by key; None takes a table or a key away. A table with another `kind` is
        taken whole. The scene itself stays as it is, and comments of its file are not in the `text` of the new one.

        Parameters
        ----------
        **changes
            Tables, `title` and `base`, as those of a new scene.

        Returns
        -------
        Scene
            The new scene, checked as any other.

        Raises
        ------
        SceneError
            If it makes no sense.
        TypeError
            If there is no table of a name.
        ValueError
            As `to_dict`.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
        >>> higher = scene.replace(grippers={"height": "80 mm"}, title="From higher up")
        >>> higher.title, float((higher.positions - scene.positions)[0, 0, 2].round(3))
        ('From higher up', 0.03)
        """
    @property
    def target(self, /) -> NDArray[float64] | None:
        """
        Where the ideal drape puts the grippers (m), shape (grippers, 3), if the ply is to be draped.
        """
    @staticmethod
    def template() -> str:
        """
        The text of a commented scene to start from, as `plydrape new` writes it.

        Returns
        -------
        str
            The text.

        Examples
        --------
        >>> plydrape.Scene.template().startswith("# A scene for plydrape")
        True
        """
    @property
    def text(self, /) -> str | None:
        """
        The text of its file, or the one that its keyword arguments stand for; None if it was made otherwise.
        """
    @property
    def times(self, /) -> NDArray[float64]:
        """
        Time of each step (s), shape (steps,).
        """
    @property
    def title(self, /) -> str:
        """
        Name for reports.
        """
    def to_dict(self, /) -> dict[str, typing.Any]:
        """
        The scene as keyword arguments of plain values, which JSON and TOML can carry: `Scene(**scene.to_dict())` is the same scene.

        Of a scene that was read, `base` is the folder of its file, in which the files are that it names. A motion or a mesh that was
        given as arrays is in it as lists.

        Returns
        -------
        dict
            The tables of its scene file, with `title` and `base`.

        Raises
        ------
        ValueError
            If no tables say it: a scene `with_errors`, a ply of a book, or one on a `Mold` that is no mesh. Pickle it.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
        >>> scene.to_dict()["mold"]["kind"]
        'sphere'
        """
    def with_errors(
        self, /, sample: SupportsIndex, factor: SupportsFloat | SupportsIndex = 1.0
    ) -> Scene:
        """
        The scene of one real cell: the same commands, with every error that `draw` gives for the sample.

        It has no `errors` of its own any more, and no `text`, as no scene file says it. An error of the
        pick-up moves no gripper: the ply is as flat as it would have been, and its `position` and `fiber_angle` are
        those of the fabric that is there instead.

        Parameters
        ----------
        sample : int
            Its number, from 0.
        factor : float, default 1.0
            How many times as large all errors are.

        Returns
        -------
        Scene
            The new scene.

        Raises
        ------
        ValueError
            If the scene has no errors, the factor is not finite, or neighbors would be (all but)
            straight above each other.

        Examples
        --------
        >>> tables = dict(ply=dict(grippers=[2, 1], cell=[0.1, 0.1], material="krogh2018"))
        >>> tables |= dict(grippers=dict(spacing=["98 mm", "98 mm"], height="75 mm"))
        >>> frame = dict(position=dict(bound="1 mm"))
        >>> scene = plydrape.Scene(**tables, motion=dict(kind="hold"), errors=dict(frame=frame))
        >>> real = scene.with_errors(0)
        >>> bool(abs(real.positions - scene.positions).max() <= 0.001), real.errors
        (True, None)
        """
    def with_motion(
        self,
        /,
        times: ArrayLike,
        positions: ArrayLike,
        *,
        title: str | None = None,
        slow: bool = False,
    ) -> Scene:
        """
        This scene along another motion. It has no `text`, as no scene file says it. Where a scene file is refused
        if its start stretches the ply, this one is draped: its overstretch says by how much.

        Parameters
        ----------
        times : array_like
            Time of each step (s), from 0, each a microsecond after the one before at least, shape (steps,).
        positions : array_like
            Positions of the grippers (m), shape (steps, grippers, 3), i running fastest, or (steps, along u, along v, 3).
        title : str, optional
            Name for reports, unless it stays.
        slow : bool
            Whether the grippers are slower than 1 mm/s; times at which they would be are refused otherwise if they look like
            milliseconds.

        Returns
        -------
        Scene
            The new scene.

        Raises
        ------
        ValueError
            If the shapes do not fit, times do not ascend from 0, a coordinate is not a number up to 10⁶ m, or
            neighbors are (all but) straight above each other, where the model has no solution.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> higher = scene.with_motion(scene.times, scene.positions + [0, 0, 0.01])
        >>> float((higher.positions - scene.positions).max().round(9))
        0.01
        """

@final
class Sheet:
    """
    The whole ply as a sheet: its states over the steps that were kept. Measures and the verdict are those of its result.

    Nodes lie where lines of the fabric cross; segments join two neighbors along a line, cells are between four nodes.
    Arrays are in m, N, rad, s unless the name says otherwise. Each access reads the states of sheet.npz once, one at a time.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> sheet = plydrape.simulate(scene).sheet
    >>> sheet.positions.shape, sheet.summary["first_contact_step"]
    ((30, 341, 3), 22)
    """
    def __repr__(self, /) -> str: ...
    @property
    def areas(self, /) -> NDArray[float64]:
        """
        Fabric area that belongs to each node (m²), shape (nodes,).
        """
    @property
    def cells(self, /) -> NDArray[uint32]:
        """
        Nodes at the corners of each cell, in order around it, shape (cells, 4).
        """
    @property
    def contact(self, /) -> NDArray[bool_]:
        """
        Whether each node is in contact with the mold, shape (states, nodes).
        """
    @property
    def converged(self, /) -> bool:
        """
        Whether every step was solved and the ply is at rest at the end.
        """
    @property
    def grippers(self, /) -> NDArray[float64]:
        """
        Positions of the grippers' pads (m), shape (states, grippers, 3).
        """
    @property
    def heights(self, /) -> NDArray[float64]:
        """
        Height of the nodes over the mold (m), shape (states, nodes); nan where there is no mold, and in the last state at nodes that hang beside it.
        """
    @property
    def landing_step(self, /) -> NDArray[int64]:
        """
        Step in which each node came to the mold and stayed, shape (nodes,); 0 of one that did not.
        """
    @property
    def pad_forces(self, /) -> NDArray[float64]:
        """
        Force of the ply on each pad (N), shape (states, grippers, 3).
        """
    @property
    def pad_holds(self, /) -> NDArray[bool_]:
        """
        Whether each pad holds the ply, shape (states, grippers). Where pads let go, the last step has two states: one held, and one
        at rest after the release.
        """
    @property
    def pad_quaternions(self, /) -> NDArray[float64]:
        """
        Orientations of the pads as quaternions x, y, z, w, shape (states, grippers, 4): z along the pad's normal, x along u.
        """
    @property
    def places(self, /) -> NDArray[float64]:
        """
        Fabric coordinates u, v of the nodes (m), shape (nodes, 2).
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Positions of the nodes (m), shape (states, nodes, 3).
        """
    @property
    def segments(self, /) -> NDArray[uint32]:
        """
        Nodes at both ends of each yarn segment, shape (segments, 2), those along u first.
        """
    @property
    def shear(self, /) -> NDArray[float64]:
        """
        Shear angle of the cells (rad), shape (states, cells).
        """
    @property
    def steps(self, /) -> NDArray[int64]:
        """
        The steps that were kept, shape (states,): they count from 1, the start. The state after a release is of the last step too.
        """
    @property
    def summary(self, /) -> dict[str, Any]:
        """
        What the sheet says beside its measures: `sheet` in its `summary` in result.json.
        """
    @property
    def tension(self, /) -> NDArray[float64]:
        """
        Tension of the segments per width (N/m), shape (states, segments).
        """
    @property
    def times(self, /) -> NDArray[float64]:
        """
        Time of each state (s), shape (states,).
        """
    def to_pyvista(self, /, step: SupportsIndex = ...) -> pyvista.PolyData:
        """
        The sheet of a step as a mesh of PyVista with its numbers. Needs PyVista.

        Parameters
        ----------
        step : int, default -1
            Which step, from 1; −1 is the last that was kept.

        Returns
        -------
        pyvista.PolyData
            Its cells, with numbers at nodes and in cells.

        Raises
        ------
        ExtraError
            If PyVista is not installed.
        ValueError
            If no state of such a step was kept.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> mesh = plydrape.simulate(scene).sheet.to_pyvista()
        >>> mesh.n_points, mesh.array_names
        (341, ['height_mm', 'contact', 'landing_step', 'shear_deg'])
        """
    def to_xarray(self, /) -> xarray.Dataset:
        """
        All states as one labeled data set. Needs xarray.

        The dimensions are `state`, `node`, `segment`, `cell`, `gripper` and `xyz`; every variable has its `units` and `long_name`.
        Names and units are those of the properties.

        Returns
        -------
        xarray.Dataset
            The data set.

        Raises
        ------
        ExtraError
            If xarray is not installed.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> data = plydrape.simulate(scene).sheet.to_xarray()
        >>> data["heights"].dims, data["heights"].attrs["units"]
        (('state', 'node'), 'm')
        """

@final
class Solver:
    """
    Finds equilibria of a hanging ply, one after another: each starts from the last one.

    Plain numbers are in SI units, a str carries its unit. A copy, also one in another process, begins without a last one.

    Parameters
    ----------
    ply : Ply
        What hangs.
    slopes : {"moment-balance", "min-force"}, default "moment-balance"
        How shared slopes are found: "moment-balance", or "min-force" as in Krogh et al. 2018.
    axial_stiffness : float or str, default 100000.0
        EA of a line of ply (N); infinite for an inextensible ply.
    gravity : float or str, default 9.81
        Acceleration of gravity (m/s²).
    max_tilt : float or str, optional
        Limit of the ball joints (rad).

    Raises
    ------
    ValueError
        If a number makes no sense.

    Examples
    --------
    >>> ply = plydrape.Ply(grippers=[4, 1], cell=[0.1, 0.1], material="krogh2018")
    >>> solver = plydrape.Solver(ply)
    >>> equilibrium = solver.solve([[0.098 * i, 0, 0] for i in range(4)])
    >>> equilibrium.status
    'converged'
    >>> bool((equilibrium.forces > 0).all())
    True
    """
    def __new__(
        cls,
        /,
        ply: Ply,
        *,
        slopes: typing.Literal["moment-balance", "min-force"] = "moment-balance",
        axial_stiffness: float | str = ...,
        gravity: float | str = ...,
        max_tilt: float | str = ...,
    ) -> Solver: ...
    def forget(self, /) -> None:
        """
        Forgets the last equilibrium: the next one starts from nothing.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> solver = plydrape.Solver.of(scene)
        >>> first = solver.solve(scene.positions[0]).forces
        >>> solver.forget()
        >>> bool((solver.solve(scene.positions[0]).forces == first).all())
        True
        """
    @staticmethod
    def of(scene: Scene) -> Solver:
        """
        A solver for the ply of a scene, by its rules.

        Parameters
        ----------
        scene : Scene
            The scene.

        Returns
        -------
        Solver
            The solver.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> plydrape.Solver.of(scene).solve(scene.positions[0]).forces.shape
        (16,)
        """
    def solve(self, /, positions: ArrayLike, *, check: bool = True) -> Equilibrium:
        """
        Solves for the grippers where they are.

        Parameters
        ----------
        positions : array_like
            Positions of the grippers (m), shape (grippers, 3), i running fastest, or of a whole array (along u, along v, 3).
        check : bool, default True
            Whether an equilibrium that was not found is an error, or just says so in its `status`.

        Returns
        -------
        Equilibrium
            The hanging ply.

        Raises
        ------
        ValueError
            If the shape does not fit, a coordinate is not a number up to 10⁶ m, or neighbors are (all
            but) straight above each other, where the model has no solution.
        SolveError
            If no equilibrium was found.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]]).status
        'converged'
        """

@final
class Span:
    """
    One free span of ply between two ends in a vertical plane, solved: a catenary with bending stiffness, by the theory of small
    sag or as the exact elastica.

    Plain numbers are in SI units, a str carries its unit.

    Parameters
    ----------
    run : float or str
        Horizontal distance of the ends (m).
    length : float or str
        Fabric length between them (m).
    weight : float or str
        Weight per length (N/m).
    flexural_rigidity : float or str, default 0.0
        EI (N·m²); slopes can be prescribed only if it is positive.
    rise : float or str, default 0.0
        Height of the second end above the first (m).
    axial_stiffness : float or str, optional
        EA (N); infinite for an inextensible ply. 1e5 unless given; the exact theory has no stretch.
    slopes : tuple of float or None, float, optional
        Prescribed slope at each end, None where it is free.
    theory : {"small-sag", "exact"}
        "small-sag", in closed form, or "exact", the inextensible elastica of any sag.
    moment : tuple of sequence, optional
        Curvatures (1/m) and moments (N·m) of a strip whose moment is no straight line, in place of flexural_rigidity;
        for the exact theory.

    Raises
    ------
    ValueError
        If a number makes no sense.
    SolveError
        If no force was found.

    Examples
    --------
    A limp span hangs as a parabola, whose sag is nearly run·√(3/8·(length/run − 1)):

    >>> span = plydrape.Span(run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-9)
    >>> round(span.sag * 1e3, 2), round(1e2 * (3 / 8 * 0.01) ** 0.5, 2)
    (6.15, 6.12)

    The elastica of a strip of the paper's ply, and the theory of small sag beside it:

    >>> strip = dict(run=0.09, length=0.1, weight=3.08014, flexural_rigidity=9e-6)
    >>> exact = plydrape.Span(**strip, theory="exact")
    >>> round(exact.force, 5), round(plydrape.Span(**strip, axial_stiffness=np.inf).force, 5)
    (0.1633, 0.15086)
    """
    def __new__(
        cls,
        /,
        *,
        run: float | str,
        length: float | str,
        weight: float | str,
        flexural_rigidity: float | str = ...,
        rise: float | str = ...,
        axial_stiffness: float | str | None = None,
        slopes: tuple[
            SupportsFloat | SupportsIndex | None, SupportsFloat | SupportsIndex | None
        ] = ...,
        theory: str = "small-sag",
        moment: tuple[
            SupportsGetItem[int, SupportsFloat | SupportsIndex],
            SupportsGetItem[int, SupportsFloat | SupportsIndex],
        ]
        | None = None,
    ) -> Span: ...
    def __repr__(self, /) -> str: ...
    @property
    def force(self, /) -> float | None:
        """
        Horizontal force H (N), negative in compression; None for a straight inextensible span.
        """
    def heights(self, /, x: ArrayLike) -> NDArray[float64]:
        """
        Height above the first end (m) at horizontal distances from it.

        Parameters
        ----------
        x : array_like
            Horizontal distances from the first end (m), of any shape.

        Returns
        -------
        ndarray
            The heights (m), of the same shape.

        Raises
        ------
        ValueError
            If a distance is not between 0 and `run`, or the span bulges beyond its ends and has several heights.

        Examples
        --------
        >>> span = plydrape.Span(run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-5)
        >>> (span.heights([0, 0.05, 0.1]) * 1e3).round(2) + 0.0
        array([ 0.  , -6.18,  0.  ])
        """
    @property
    def length(self, /) -> float:
        """
        Fabric length between the ends (m).
        """
    def points(self, /, n: SupportsIndex = 101) -> NDArray[float64]:
        """
        Places: at equal lengths along the span by the exact theory, at equal distances by that of small sag.

        Parameters
        ----------
        n : int, default 101
            How many, 2 to 100 000.

        Returns
        -------
        ndarray
            Horizontal distance and height from the first end (m), shape (n, 2).

        Raises
        ------
        ValueError
            If n is below 2 or above 100 000.

        Examples
        --------
        >>> span = plydrape.Span(run=0.02, length=0.1, weight=3.0, flexural_rigidity=1e-4, theory="exact")
        >>> span.points(3)[1].round(4) + 0.0
        array([ 0.01  , -0.0409])
        """
    @property
    def rise(self, /) -> float:
        """
        Height of the second end above the first (m).
        """
    @property
    def run(self, /) -> float:
        """
        Horizontal distance of the ends (m).
        """
    @property
    def sag(self, /) -> float:
        """
        Largest vertical distance below its chord (m).
        """
    @property
    def slopes(self, /) -> tuple[float, float]:
        """
        Slopes at both ends.
        """
    @property
    def state(self, /) -> str:
        """
        How it holds its length: "hanging", "overstretched" or "straight".
        """

@final
class Surface:
    """
    The ply of one step as a surface.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene, model="catenaries")
    >>> bool((result.surface(1).gap > 0).all())
    True
    """
    @property
    def gap(self, /) -> NDArray[float64]:
        """
        Distance of each point from the mold (m), negative inside it, shape (points,); nan without a mold.
        """
    @property
    def points(self, /) -> NDArray[float64]:
        """
        Points (m), shape (points, 3), u running fastest.
        """
    @property
    def size(self, /) -> tuple[int, int]:
        """
        Points along u and along v.
        """
    def to_pyvista(self, /) -> pyvista.StructuredGrid:
        """
        The surface as a structured grid of PyVista, of a strip as a line, with `gap_mm` at its points. Needs PyVista.

        Returns
        -------
        pyvista.StructuredGrid
            The grid, u running fastest.

        Raises
        ------
        ExtraError
            If PyVista is not installed.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene, model="catenaries")
        >>> grid = result.surface(-1, intervals=4).to_pyvista()
        >>> grid.dimensions, grid.array_names
        ((13, 5, 1), ['gap_mm'])
        """
    @property
    def triangles(self, /) -> NDArray[uint32]:
        """
        Corners of its triangles, shape (triangles, 3); none for a strip.
        """

def _restore(name: str, state: str, file: bytes | None) -> Any:
    """
    The object of a class with a state.
    """

def _si(value: float | str, measured: str, name: str) -> float:
    """
    A quantity in SI units, for what is written in Python: an angle (rad) or a length (m).
    """

def _state(value: Any, whole: bool) -> tuple[str, bytes | None]:
    """
    The state of an object: all of it, or what it is compared by.
    """

def equilibria(
    solver: Solver,
    positions: ArrayLike,
    *,
    threads: SupportsIndex | None = None,
    progress: typing.Callable[[int, int, str], object] | None = None,
) -> Equilibria:
    """
    Solves for many places of the grippers, on all cores; each from nothing, so that none depends on another.

    Parameters
    ----------
    solver : Solver
        The ply and its rules.
    positions : array_like
        Positions of the grippers (m), shape (n, grippers, 3), i running fastest, or of a whole array (n, along u, along v, 3).
    threads : int, optional
        How many at once; one a core unless given. The results do not depend on it.
    progress : callable, optional
        Called with (equilibria done, equilibria, what is done), some 50 times a second.

    Returns
    -------
    Equilibria
        One equilibrium a row; those not found say so in `converged`.

    Raises
    ------
    ValueError
        If the shape does not fit, a coordinate is not a number up to 10⁶ m, or neighbors are (all but)
        straight above each other, where the model has no solution; it names the row.

    Examples
    --------
    >>> ply = plydrape.Ply(grippers=[4, 1], cell=[0.1, 0.1], material="krogh2018")
    >>> level = np.array([[0.098 * i, 0, 0] for i in range(4)])
    >>> batch = plydrape.batch.equilibria(plydrape.Solver(ply), [level, 1.01 * level])
    >>> batch.forces.shape, batch.converged.all()
    ((2, 3), np.True_)
    """

def fit(
    test: str,
    warp: SupportsGetItem[int, str | PathLike[str]] = ...,
    weft: SupportsGetItem[int, str | PathLike[str]] = ...,
    *,
    width: float | str | None = None,
    length: float | str | None = None,
    side: float | str | None = None,
    fabric: float | str | None = None,
    mass: float | str | None = None,
    angle: float | str = ...,
    displacement: str | None = None,
    force: str | None = None,
    overhang: str | None = None,
    x: str | None = None,
    z: str | None = None,
    curvature: str | None = None,
    moment: str | None = None,
) -> dict[str, Any]:
    """
    Fits laws of a material to tables of its tests, as `plydrape fit` does.

    Plain numbers are in SI units, a str carries its unit.

    Parameters
    ----------
    test : {"bias", "rate", "frame", "overhang", "hang", "moments"}
        What was tested; "rate" is bias extension with a column of the time.
    warp : sequence of str or path
        CSV files, one a specimen: of a shear test, or of strips along the warp.
    weft : sequence of str or path
        CSV files of strips along the weft.
    width : float or str, optional
        Width of bias-extension specimens (m).
    length : float or str, optional
        Length between the clamps, or of the overhang of hanging strips (m).
    side : float or str, optional
        Side of the picture frame (m).
    fabric : float or str, optional
        Side of the fabric that shears in it (m).
    mass : float or str, optional
        Mass per area (kg/m²).
    angle : float or str, default "41.5 deg"
        Angle of the chord of overhangs (rad).
    displacement, force : str, optional
        Titles of the columns of a shear test, where they have other names than usual.
    overhang : str, optional
        Title of the column of overhangs.
    x, z : str, optional
        Titles of the columns of points of a hanging strip.
    curvature, moment : str, optional
        Titles of the columns of a bending test.

    What a file states of its own specimen is used for its rows; the measures that are given here are those of files that state none.

    Returns
    -------
    dict
        What was fitted, with standard errors and 95 % intervals, `notes` of what the files show beside it, and `toml`, the lines of a
        material file.

    Raises
    ------
    SceneError
        If a table is broken, states no measure that is not given either, or shows what no specimen does.
    ValueError
        If the points say no law.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> file = Path(mkdtemp()) / "strips.csv"
    >>> _ = file.write_text("overhang (mm)\\n61.5\\n63\\n60.5\\n62.5\\n62.5\\n")
    >>> found = plydrape.fit("overhang", [file], mass="314 g/m^2")
    >>> 'bending_rigidity_warp = "9.178e-5 N m"' in found["toml"]
    True
    """

def materials() -> list[str]:
    """
    Names of the materials that come with plydrape.

    Returns
    -------
    list of str
        The names.

    Examples
    --------
    >>> plydrape.materials()[:4]
    ['krogh2018', 'dry_carbon', 'prepreg_cold', 'prepreg_warm']
    """

def measures() -> list[Measure]:
    """
    Everything that is measured of drapes, in the order of tables.

    Returns
    -------
    list of Measure
        One for each measure.

    Examples
    --------
    >>> tilt = next(measure for measure in plydrape.measures() if measure.name == "tilt")
    >>> tilt.key, tilt.unit, tilt.shown, tilt.sense, tilt.scope
    ('tilt_deg', 'deg', '°', 'at-most', 'every-step')
    """

def outcome(
    scene: Scene, *, progress: typing.Callable[[int, int, str], object] | None = None
) -> Outcome:
    """
    Drapes a scene along its motion by catenaries, whatever its model is, and differentiates where the ply has come to.

    Parameters
    ----------
    scene : Scene
        The scene.
    progress : callable, optional
        As that of `simulate`.

    Returns
    -------
    Outcome
        The last step with its derivatives.

    Raises
    ------
    SceneError
        If catenaries cannot drape the scene.
    ValueError
        If the drape has no steps, or the derivatives would take more memory than allowed.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    >>> outcome = plydrape.outcome(scene)
    >>> outcome.overstretch.shape, outcome.overstretch_jacobian.shape
    ((1,), (1, 2, 3))
    """

def plan(
    scene: Scene,
    *,
    method: typing.Literal["path", "stepwise"] | None = None,
    seed: SupportsIndex | None = None,
    improve: bool | None = None,
    time: float | str | None = None,
    checkpoint: str | None = None,
    also: typing.Literal["sheet", "catenaries"] | None = None,
    without_errors: bool = False,
    progress: typing.Callable[[int, int, str], object] | None = None,
) -> Plan:
    """
    Finds a motion that lays the ply of a scene on its mold, as `plydrape plan` does.

    The scene's model drapes and decides. A start at which the ply would hang into the mold is raised first, and a warning says so.

    The search ends with a plan that keeps all limits with a margin. Other threads of Python run on meanwhile. Ctrl-C raises
    KeyboardInterrupt at once; to stop early and keep the best so far, give the search a `time`, or fewer `evaluations`
    in the scene's `plan`.

    The plan is then judged with errors: by a sample of cells where the scene has `errors`, and what it tolerates is found. That takes
    those of the sample and some more, forty-six on the dome, which `time` does not bound.

    Parameters
    ----------
    scene : Scene
        The scene, with mold and target.
    method : {"path", "stepwise"}, optional
        "path" or "stepwise", instead of the scene's.
    seed : int, optional
        Seed of the search, instead of the scene's: the same seed, the same plan.
    improve : bool, optional
        Whether to go on improving a plan that keeps all limits with a margin, until the `evaluations` of the scene's
        `plan` are used up or the time is over, instead of what the scene says.
    time : float or str, optional
        Time after which the search ends with the best plan so far, in seconds or with a unit, as "5 min"; what
        follows it ends after as much again, and a plan whose drape or sample is not complete then is not accepted.
    checkpoint : str, optional
        Text of the plan.json of an earlier search, from which to continue: see `Plan.checkpoint`.
    also : {"sheet", "catenaries"}, optional
        The model that does not decide, to be draped along the plan too and shown beside as `Result.also`; it never judges.
    without_errors : bool, default False
        Whether the plan is looked for and judged without errors: a quick look.
    progress : callable, optional
        Called with (candidates draped, most, what is done), some 50 times a second. While the sheet decides on a plan, the last one
        says how long that will take in all, as "deciding: 961 nodes, about 4 s".

    Returns
    -------
    Plan
        The best plan found, whether or not it is accepted.

    Raises
    ------
    PlanError
        If the scene has no mold or target, or `checkpoint` is not of its ply.
    SceneError
        If its motion has a `duration`, which a plan would ignore, or if a model cannot drape it.
    ValueError
        If there is no such method, `time` is no time above zero, or `checkpoint` is no plan.json.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> plan = plydrape.plan(scene, without_errors=True)
    >>> plan.method, plan.result.accepted
    ('path', True)
    """

def simulate(
    scene: Scene,
    *,
    model: typing.Literal["sheet", "catenaries"] | None = None,
    also: typing.Literal["sheet", "catenaries"] | None = None,
    without_errors: bool = False,
    progress: typing.Callable[[int, int, str], object] | None = None,
) -> Result:
    """
    Drapes the ply of a scene along its motion, as `plydrape simulate` does.

    One model drapes and decides. Other threads of Python run on meanwhile, and Ctrl-C ends it. A scene with errors is judged by a
    sample of its cells too.

    Parameters
    ----------
    scene : Scene
        The scene.
    model : {"sheet", "catenaries"}, optional
        The model that drapes and decides, instead of the scene's.
    also : {"sheet", "catenaries"}, optional
        The other model, to be draped too and shown beside as `Result.also`; it never judges.
    without_errors : bool, default False
        Whether the errors of the scene are left out.
    progress : callable, optional
        Called with (steps done, steps, what is done) as the drape gets on, some 50 times a second.

    Returns
    -------
    Result
        The result; a drape that breaks limits is a result all the same.

    Raises
    ------
    SceneError
        If a model cannot drape the scene: its material lacks a stiffness that the sheet needs, for instance.
    OutputError
        If the states of the sheet cannot be kept in the folder for temporary files.
    ValueError
        If there is no such model.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    >>> plydrape.simulate(scene).accepted
    True
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene, also="catenaries")
    >>> result.model, result.also.model
    ('sheet', 'catenaries')
    """

def simulate_all(
    scenes: typing.Iterable[Scene],
    *,
    model: typing.Literal["sheet", "catenaries"] | None = None,
    also: typing.Literal["sheet", "catenaries"] | None = None,
    threads: SupportsIndex | None = None,
    progress: typing.Callable[[int, int, str], object] | None = None,
) -> list[Result]:
    """
    Drapes many scenes along their motions, on all cores.

    Parameters
    ----------
    scenes : iterable of Scene
        The scenes.
    model : {"sheet", "catenaries"}, optional
        The model that drapes and decides, instead of that of each scene.
    also : {"sheet", "catenaries"}, optional
        The other model, to be draped too and shown beside as `Result.also`; it never judges.
    threads : int, optional
        How many at once; one a core unless given. The results do not depend on it.
    progress : callable, optional
        Called with (drapes done, drapes, what is done), some 50 times a second.

    Returns
    -------
    list of Result
        One result a scene, in their order.

    Raises
    ------
    SceneError, OutputError, ValueError
        As `simulate`.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    >>> [result.accepted for result in plydrape.batch.simulate([scene, scene])]
    [True, True]
    """
