# SPDX-License-Identifier: BSD-3-Clause
"""Learning from a data set."""
from __future__ import annotations

import json
import os

from . import _core
from ._common import overrides, threads_of, warn
from ._dataset import Dataset, folder_of


def train(data: Dataset | str | os.PathLike, output: str | os.PathLike, *, split: str | None = None, threads: int = 0, **learning) -> dict:
    """Trains network and trees on a data set and evaluates them on unseen maps and seas: `seaglint train`.

    data: a Dataset, or the folder of `generate` or `run`. output: the directory of the model; one that is there is
    replaced when the new one is complete. learning: keys of the scenario's `learning`, epochs=40, fusion="in_sample";
    split: its `dataset.split`, "8:2". Returns the dictionary of metrics.json: accuracies with their intervals by
    features and protocol, probes. Depends on data and settings only, not on threads (0 = all processors).

    libtorch is loaded by the first call. A terminal shows the progress; Ctrl-C ends the training and keeps the earlier
    model.
    """
    folder = data.folder if isinstance(data, Dataset) else folder_of(data)
    settings = overrides(learning, "learning.") + ([] if split is None else [("dataset.split", str(split))])
    metrics, warnings = _core.train(os.fspath(folder), os.fspath(output), settings, threads_of(threads))
    warn(warnings)
    return json.loads(metrics)
