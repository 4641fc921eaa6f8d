"""What programs other than Slicer make of the modules: python drive.py FOLDER

The modules are found by PATH. ctk-cli and slicer_cli_web read their descriptions; nipype makes
classes of them, which then run on the inputs in FOLDER and write their results there.
"""

import importlib.util
import os
import shutil
import subprocess
import sys

from ctk_cli import CLIModule
from nipype.interfaces.slicer.generate_classes import generate_all_classes
from slicer_cli_web.cli_utils import as_model

NAMES = ["HeatpathDistance", "HeatpathPath", "HeatpathVesselTree", "HeatpathMeshDistance"]


def read_descriptions():
    for name in NAMES:
        inputs, options, outputs = CLIModule(shutil.which(name)).classifyParameters()
        # Input and output have places, everything else options; nothing is returned as a number.
        assert len(inputs) == 2 and len(options) >= 7 and not outputs, name
        xml = subprocess.run([name, "--xml"], check=True, capture_output=True).stdout
        model = as_model(xml)
        assert model.category == "Heatpath" and len(model) >= 2, name


def nipype_classes():
    """The generated file imports its package by a relative name, so it is loaded as a part of it."""
    generate_all_classes(modules_list=NAMES, launcher=["/usr/bin/env"])
    spec = importlib.util.spec_from_file_location("nipype.interfaces.slicer.heatpath", "heatpath.py")
    classes = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(classes)
    return classes


def run(module, **inputs):
    result = module(**inputs).run()
    assert result.runtime.returncode == 0 and not result.runtime.stderr, result.runtime
    assert "<filter-end>" in result.runtime.stdout
    return result.outputs


os.chdir(sys.argv[1])
read_descriptions()
heatpath = nipype_classes()
volume = {"inputVolume": "volume.nrrd", "sourcesFile": "sources.csv"}
run(
    heatpath.HeatpathDistance,
    outputVolume="distance.nrrd",
    medium="combined",
    power=2.0,
    contrast=0.05,
    range=[0.0, 200.0],
    **volume,
)
run(heatpath.HeatpathPath, outputPaths="path.vtp", endsFile="ends.csv", **volume)
run(
    heatpath.HeatpathVesselTree,
    inputVolume="volume.nrrd",
    outputTree="tree.vtp",
    outputDensity="votes.nrrd",
    scale=[1.5, 2.0],
    polarity="bright",
)
run(
    heatpath.HeatpathMeshDistance,
    inputModel="mesh.off",
    outputModel="mesh.vtp",
    args="--source 0,0,0.1 --source 4,6,0",
    method="heat",
)
