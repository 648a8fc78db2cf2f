# SPDX-License-Identifier: Apache-2.0
"""Virtual phenotyping farms, simulated LiDAR flights, and plots and crop heights from clouds.

Each function does what a command of the programs does, with the same options, the same files and the
same text in its errors (docs/python.md). Frames are east, north, up; metres, seconds, degrees. The same
input gives the same result for any number of threads.

Long work can be interrupted with Ctrl-C, and takes `progress`, a callable that is given the share done,
0 to 1, in the calling thread. What it raises ends the work. Nothing half-written is left behind.
"""

from __future__ import annotations

import json
import os
import reprlib
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy

from . import _plotscan
from ._plotscan import (
    BadInput,
    Box,
    BoxError,
    Cloud,
    FarmSummary,
    FieldEstimate,
    FlightSummary,
    GroundGrid,
    Height,
    HeightScore,
    NothingMeasured,
    Plot,
    Scores,
    Setting,
    TruePlot,
    point_dtype,
)

__all__ = [
    "BadInput", "Box", "BoxError", "Cloud", "FarmSummary", "FieldEstimate", "FlightSummary", "GroundGrid",
    "Height", "HeightScore", "NothingMeasured", "Plot", "Scores", "Setting", "TruePlot", "convert_cloud", "data_folder",
    "estimate_field", "estimate_files", "estimate_settings", "flight_settings", "fly", "generate_farm", "plot_table", "point_dtype",
    "read_cloud", "read_truth", "score_estimate", "write_cloud",
]  # fmt: skip

__version__ = _plotscan.version()

Path = Union[str, "os.PathLike[str]"]
SettingValue = Union[float, bool, str, Sequence[float], None]
Progress = Optional[Callable[[float], Any]]


def _told(self: Any) -> str:
    """What the object holds, in short; of an estimate not its documents and its ground."""
    short = reprlib.Repr()
    short.maxlist, short.maxstring, short.maxother = 1, 60, 120
    names = [name for name, value in vars(type(self)).items() if isinstance(value, property)]
    shown = [name for name in names if name not in ("geojson", "diagnostics", "ground")]
    return f"{type(self).__name__}({', '.join(f'{name}={short.repr(getattr(self, name))}' for name in shown)})"


for _class in (Box, BoxError, FarmSummary, FieldEstimate, FlightSummary, Height, HeightScore, Plot, Scores, Setting, TruePlot):
    _class.__repr__ = _told  # type: ignore[method-assign]


def data_folder() -> str:
    """The folder of the data that Plotscan ships: worlds/, models/, benchmarks/suites/.

    It is what the environment variable PLOTSCAN_DATA names, else what was installed with the module.
    Raises BadInput where there is none.
    """
    return str(_plotscan.data_folder())


def generate_farm(
    description: Path,
    folder: Path,
    *,
    set: Optional[Mapping[str, Any]] = None,
    seed: Optional[int] = None,
    threads: int = 0,
    replace: bool = False,
    progress: Progress = None,
) -> FarmSummary:
    """Make a farm from its description and write its folder, as `farmgen generate` does.

    description: a YAML file (docs/farm-format.md), or the name of a shipped one, "paper_half".
    set: values in place of the description's by dotted keys, {"terrain.relief_m": 0.5}; numbers, lists, maps,
        arrays, or YAML as text.
    seed: of all that is drawn; else the description's, else 1.
    threads: 0 is one for each processor.
    replace: a farm that is there.

    Raises BadInput on a description that does not hold, a mesh that cannot be read, a folder that exists.
    """
    assignments = [f"{key}={_text(value)}" for key, value in (set or {}).items()]
    drawn = None if seed is None else _seed(seed)
    return _plotscan.generate_farm(description, folder, assignments, drawn, threads, replace, progress)


def read_truth(farm: Path) -> List[TruePlot]:
    """The plots of a farm folder as they are, or of a GeoJSON file with numbers height_<name>_m.

    Raises BadInput where there is no plot.
    """
    return _plotscan.read_truth(farm)


def flight_settings() -> List[Setting]:
    """Every setting that `fly` takes, with its help and its usual value."""
    return _plotscan.flight_settings()


def fly(
    place: Path,
    folder: Path,
    *,
    trajectory: Optional[Path] = None,
    waypoints: Optional[Path] = None,
    formats: Union[str, Sequence[str]] = (),
    resource_paths: Union[Path, Sequence[Path]] = (),
    seed: int = 1,
    threads: int = 0,
    replace: bool = False,
    progress: Progress = None,
    **settings: SettingValue,
) -> FlightSummary:
    """Fly the drone over a farm or an SDF world and write the scan folder, as `lidarsim fly` does.

    place: a farm folder, or the file of an SDF world or model.
    trajectory, waypoints: files to fly in place of planned strips (docs/flight.md).
    formats: "ply", "las", "pcap", "bag", "mcap", one or several: written beside cloud.pcd.
    resource_paths: folder or folders of an SDF world's models.
    settings: by the keys of `flight_settings()`: sensor="os1_64", altitude_m=12, wind_m_s=4. None is not set.

    Raises BadInput on settings out of their range, a place that cannot be read, a folder that exists.
    """
    options = _plotscan.FlightOptions()
    options.settings = _set(settings)
    options.trajectory = trajectory
    options.waypoints = waypoints
    options.formats = _several(formats)
    options.resource_paths = _several(resource_paths)
    options.seed = _seed(seed)
    options.threads = threads
    options.replace = replace
    return _plotscan.fly(place, folder, options, progress)


def read_cloud(file: Path, *, progress: Progress = None) -> Cloud:
    """Read a PCD, PLY, LAS or text cloud, a recording (bag, MCAP) or a scan folder (its cloud.pcd).

    The cloud's `points` are an array (N,) of `point_dtype`, in the file's order, that shares the cloud's
    memory: x, y, z in metres from `origin_m`, intensity 0 to 255, ring from 0, time in seconds,
    return_number, return_count, label (0 unlabelled, 1 ground, 2 crop, 3 weed, 4 other), plot, plant.
    `fields` are those that the file has. Points that are not finite are left out.

    Raises BadInput on a missing, foreign, truncated or empty file.
    """
    return _plotscan.read_cloud(file, progress)


def write_cloud(
    file: Path,
    points: Union[Cloud, numpy.ndarray],
    *,
    origin_m: Tuple[float, float, float] = (0.0, 0.0, 0.0),
    encoding: str = "",
    replace: bool = False,
    progress: Progress = None,
) -> None:
    """Write points as PCD, PLY or LAS, by the file's extension; the file appears whole or not at all.

    points: a cloud, which brings its own origin, or an array (N,) of `point_dtype`; it is not copied.
    origin_m: what the points' x, y, z count from, metres.
    encoding: one of the format's (docs/formats.md): "ascii", "binary", ...; "" is its first.

    Raises BadInput on an extension or encoding that there is not, on masked points, on a time or intensity that is not finite,
    and on a file that exists.
    """
    _require_points(points)
    _require_one_origin(points, origin_m)
    crs_wkt = ""
    if isinstance(points, Cloud):
        origin_m, crs_wkt, points = points.origin_m, points.crs_wkt, points.points
    _plotscan.write_cloud(file, points, origin_m, crs_wkt, encoding, replace, progress)


def convert_cloud(
    source: Path,
    file: Path,
    *,
    encoding: str = "",
    crs: str = "",
    topic: str = "",
    replace: bool = False,
    progress: Progress = None,
) -> int:
    """Convert a scan folder, cloud, recording or trajectory to the format of the file's extension.

    It is what `lidarsim convert` does; points stream.

    encoding: one of the format's (docs/formats.md); "" is its first.
    crs: of LAS, "local" or "utm".
    topic: of the clouds in a bag or MCAP file, where there are several.

    Returns how many points, or poses of a trajectory, were written.

    Raises BadInput on broken input, and where the file needs what the source does not say.
    """
    return _plotscan.convert_cloud(source, file, encoding, crs, topic, replace, progress)


def estimate_settings(method: str = "lattice") -> List[Setting]:
    """Every setting of a method, "lattice" or "dhami2020", with its help and its usual value.

    Raises BadInput on another name.
    """
    return _plotscan.estimate_settings(method)


def _seed(seed: int) -> int:
    """The seed, which the compiled part takes as 64 bits without a sign."""
    most = 2**64 - 1
    if not hasattr(seed, "__index__") or not 0 <= seed <= most:
        raise BadInput(f"seed: {seed!r} is not a whole number in [0, {most}]")
    return seed


def _require_points(points: Union[Cloud, numpy.ndarray]) -> None:
    """Refuse what is no array, and masked values, which the compiled part would take for points."""
    if not isinstance(points, (Cloud, numpy.ndarray)):
        raise BadInput(
            f"points are a NumPy array or a cloud, not of type {type(points).__name__}; numpy.asarray makes an array"
        )
    if isinstance(points, numpy.ma.MaskedArray) and numpy.any(numpy.asarray(points.mask).view(bool)):
        raise BadInput(
            "points have masked values, and masks are not read: give the points that count (points[~mask]), "
            "or NaN for the others (points.filled(numpy.nan))"
        )


def _require_one_origin(points: Union[Cloud, numpy.ndarray], origin_m: Sequence[float]) -> None:
    if isinstance(points, Cloud) and tuple(origin_m) != (0.0, 0.0, 0.0):
        raise BadInput("origin_m is of an array; a cloud brings its own origin")


def estimate_field(
    points: Union[Cloud, numpy.ndarray],
    *,
    origin_m: Tuple[float, float, float] = (0.0, 0.0, 0.0),
    crop_box: Optional[Tuple[float, float, float, float]] = None,
    boxes: Sequence[Box] = (),
    threads: int = 0,
    progress: Progress = None,
    **settings: SettingValue,
) -> FieldEstimate:
    """Find the plots of a cloud held in memory and measure their heights, by the method `lattice`.

    points: an array (N, 3) of float32 or float64, or more columns of which x, y, z are the first, metres,
        z up; or a cloud, or its points. The array is read where it lies. Points that are not finite are
        left out.
    origin_m: what positions in float32 count from, metres; a cloud brings its own, float64 has none.
    crop_box: x0, y0, x1, y1: use only the points in here; else the densely scanned field is found.
    boxes: given plots: heights only, none is searched.
    settings: by the keys of `estimate_settings()`: rows=3, crop="maize", calibrated=False. None is not set.

    A field without plots has an estimate without plots; `why_no_plots` says why. Raises BadInput on settings that
    there are not or out of their range, on boxes without finite sides above 0, on an array that would have to be
    copied, on masked values, on float32 that counts in steps of over 5 cm, as UTM's northings do, and when no point
    lies in the area; NothingMeasured when the points show no ground.

    Method: docs/methods.md, of this project.
    """
    _require_points(points)
    _require_one_origin(points, origin_m)
    options = _field_options(crop_box, threads, settings)
    options.boxes = list(boxes)
    return _plotscan.estimate_field(points, options, origin_m, progress)


def estimate_files(
    clouds: Union[Path, Sequence[Path]],
    folder: Path,
    *,
    method: str = "lattice",
    crop_box: Optional[Tuple[float, float, float, float]] = None,
    boxes: Optional[Path] = None,
    id: Optional[str] = None,
    units: Optional[str] = None,
    crs: Optional[str] = None,
    trajectory: Optional[Path] = None,
    sensor: Optional[str] = None,
    mount_rpy_deg: Optional[Tuple[float, float, float]] = None,
    topic: str = "",
    leave_out_classes: Sequence[int] = (),
    first_number: Optional[int] = None,
    numbering: Optional[str] = None,
    first_corner: Optional[str] = None,
    plot_names: Optional[Path] = None,
    measured: Optional[Path] = None,
    csv: Optional[Path] = None,
    seed: int = 1,
    threads: int = 0,
    replace: bool = False,
    progress: Progress = None,
    **settings: SettingValue,
) -> FieldEstimate:
    """Read clouds as one and write the estimate folder, as `estimator run` does.

    clouds: PCD, PLY, LAS or text files, scan folders, folders of tiles, recordings; one or several.
    method: "lattice", or "dhami2020", which needs `plots`.
    crop_box: x0, y0, x1, y1: use only the points in here; else the densely scanned field is found.
    boxes: a map of the plots (GeoJSON, GeoPackage, shapefile, an estimate's folder): heights in its boxes, its ids and
        attributes kept.
    id: property of the map, or column of `plot_names` and `measured`, that holds the plots' ids.
    units: of the coordinates, "m", "cm", "mm", "ft" or "us-ft"; else what the file states.
    crs: of the coordinates, "EPSG:32617", UTM in metres or degrees; else what the file states.
    trajectory, sensor, mount_rpy_deg: of a pcap: where the drone was (TUM or trajectory.csv), the sensor's name or
        file, and its roll, pitch, yaw in the body's frame.
    topic: of the clouds in a bag or MCAP file, where there are several.
    leave_out_classes: ASPRS classes of points to leave out.
    first_number, numbering, first_corner: of the plots that are found: 101; "zigzag" or "serpentine"; "sw", "se", "nw" or "ne".
    plot_names: a table of the plots' names by row and column.
    measured: a table of heights measured by hand in at least 5 plots, with which the estimate's are made to agree.
    csv: a table for breeding databases to write as well.
    settings: by the keys of `estimate_settings(method)`: plots=30, crop="maize". None is not set.

    A field without plots has an estimate without plots; `why_no_plots` says why. Raises BadInput on bad input, NothingMeasured
    when the points show no ground; nothing is left behind then.
    """
    options = _plotscan.EstimateFilesOptions()
    options.field = _field_options(crop_box, threads, settings)
    options.method = method
    options.boxes = boxes
    options.id = id
    options.units = units
    options.crs = crs
    options.trajectory = trajectory
    options.sensor = sensor
    options.mount_rpy_deg = mount_rpy_deg
    options.topic = topic
    options.first_number = first_number
    options.numbering = numbering
    options.first_corner = first_corner
    options.plot_names = plot_names
    options.leave_out_classes = list(leave_out_classes)
    options.measured = measured
    options.csv = csv
    options.seed = _seed(seed)
    options.replace = replace
    return _plotscan.estimate_files(_several(clouds), folder, options, progress)


def score_estimate(
    estimate: Union[FieldEstimate, Path], truth: Path, *, min_iou: float = 0.5, id: Optional[str] = None
) -> Scores:
    """Compare an estimate with the truth, as `estimator score` does.

    estimate: what `estimate_field` or `estimate_files` returned, an estimate folder, or a GeoJSON file.
    truth: a farm folder, a GeoJSON file of plots with heights, or a table (.csv) of measured ones (docs/benchmark.md).
    min_iou: least intersection over union for a plot to count as found, over 0 and at most 1.
    id: the column of a table that names the plots.

    `notes` of the scores say why there is less than was asked for. Errors are estimate minus truth, metres; what cannot be computed is NaN. Raises BadInput on bad input.
    """
    return _plotscan.score_estimate(estimate, truth, min_iou, id or "")


def plot_table(plots: Sequence[Plot]) -> Dict[str, numpy.ndarray]:
    """The plots as columns, arrays (plots,), from which pandas and polars make a table.

    id, trial (0 where the field is one), row, column, center_x_m, center_y_m, width_m, length_m, heading_deg, points,
    and for each height by its name <name>_m, <name>_standard_error_m, <name>_low95_m, <name>_high95_m; NaN where it is not known; then
    confidence (NaN where it is not known) and flags ("; " between them, "" without any). The box's standard errors
    are in each plot's box_error.
    """
    box_columns = ("center_x_m", "center_y_m", "width_m", "length_m", "heading_deg")
    table = {name: numpy.array([getattr(plot, name) for plot in plots]) for name in ("id", "trial", "row", "column")}
    for name in box_columns:
        table[name] = numpy.array([getattr(plot.box, name) for plot in plots])
    table["points"] = numpy.array([plot.points for plot in plots])
    for height in sorted({name for plot in plots for name in plot.heights}):
        found = [plot.heights.get(height) for plot in plots]
        for value in ("value_m", "standard_error_m", "low95_m", "high95_m"):
            name = f"{height}_m" if value == "value_m" else f"{height}_{value}"
            table[name] = numpy.array([getattr(one, value) if one else numpy.nan for one in found])
    table["confidence"] = numpy.array([plot.confidence for plot in plots], dtype=float)
    table["flags"] = numpy.array(["; ".join(plot.flags) for plot in plots], dtype=str)
    return table


def _several(names: Union[Path, Sequence[Path]]) -> List[Any]:
    return [names] if isinstance(names, (str, os.PathLike)) else list(names)


def _text(value: Any) -> str:
    """A value as YAML reads it: a text as it is; numbers, lists and maps as JSON writes them."""
    if isinstance(value, str):
        return value
    return json.dumps(value, default=lambda other: other.tolist() if hasattr(other, "tolist") else os.fspath(other))


def _field_options(
    crop_box: Optional[Sequence[float]], threads: int, settings: Mapping[str, Any]
) -> _plotscan.EstimateOptions:
    options = _plotscan.EstimateOptions()
    options.crop_box = crop_box
    options.threads = threads
    options.settings = _set(settings)
    return options


def _set(settings: Mapping[str, SettingValue]) -> Dict[str, Any]:
    return {key: value for key, value in settings.items() if value is not None}
