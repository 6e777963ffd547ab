# SPDX-License-Identifier: BSD-3-Clause
"""Learning from a data set, and models on other data sets."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence

from . import _core
from ._common import overrides, threads_of, warn
from ._core import InputError
from ._dataset import Dataset, folder_of


def train(data: Dataset | str | os.PathLike, output: str | os.PathLike, *, split: str | None = None, by: str | None = None,
          hold_out: Mapping[str, object] | None = None, threads: int = 0, **learning) -> dict:
    """Trains network and trees on a data set and evaluates them on unseen maps and seas: `seaglint train`.

    data: a Dataset, or the folder of `generate` or `run`. output: the directory of the model; one that is there is
    replaced when the new one is complete. learning: keys of the scenario's `learning`, epochs=40, fusion="in_sample";
    split: its `dataset.split`, "8:2"; by, hold_out: its `learning.split`, by="azimuth_deg",
    hold_out={"target_name": ["ring", "line"], "sea.peak_period_s": "8:10"}. Returns the dictionary of metrics.json: accuracies with their intervals by
    features and protocol, probes. Depends on data and settings only, not on threads (0 = all processors).

    libtorch is loaded by the first call. A terminal shows the progress; Ctrl-C ends the training and keeps the earlier
    model.
    """
    folder = data.folder if isinstance(data, Dataset) else folder_of(data)
    others = {"dataset.split": None if split is None else str(split), "learning.split.by": by, "learning.split.hold_out": None if hold_out is None else dict(hold_out)}
    settings = overrides(learning, "learning.") + overrides({key: value for key, value in others.items() if value is not None})
    metrics, warnings = _core.train(os.fspath(folder), os.fspath(output), settings, threads_of(threads))
    warn(warnings)
    return json.loads(metrics)


def evaluate(model: str | os.PathLike, data: Dataset | str | os.PathLike | Sequence[Dataset | str | os.PathLike], *, by: Sequence[str] = (), trained_rows: bool = False,
             unseen_seas: bool = False, output: str | os.PathLike | None = None) -> dict:
    """Applies a model of `train` to one data set or several: `seaglint evaluate`.

    by: columns by which the accuracy is given in addition. trained_rows: also the maps that the model was fitted to;
    unseen_seas: only maps in seas without such a map. output: a directory for evaluation.json and probabilities.csv.
    Returns the dictionary of evaluation.json: scores of each group of features with their intervals, confusion, ROC,
    calibration, scores by column, counts of maps outside the training range.
    """
    several = [data] if isinstance(data, (Dataset, str, os.PathLike)) else list(data)
    folders = [os.fspath(each.folder if isinstance(each, Dataset) else folder_of(each)) for each in several]
    if not folders:
        raise InputError("data: must be a data set or several")
    columns = [by] if isinstance(by, str) else [str(name) for name in by]
    evaluation, warnings = _core.evaluate(os.fspath(model), folders, columns, bool(trained_rows), bool(unseen_seas), "" if output is None else os.fspath(output))
    warn(warnings)
    return json.loads(evaluation)
