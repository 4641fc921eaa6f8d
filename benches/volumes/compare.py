#!/usr/bin/env python3
"""Medical files side by side: heatpath with SimpleITK, nibabel and pydicom.

    pip install -r benches/volumes/requirements.txt
    cargo build --release -p heatpath-io --example convert
    python3 benches/volumes/compare.py FILE_OR_FOLDER ...

Each file (of a folder: each file in it, and the folder itself as a series if it holds DICOM) is
read by heatpath, written in every format that keeps a place in the world, and compared with what the
others read from the same file and from what was written: values, spacing, origin, direction.
Files that heatpath refuses are listed with its line. Ends with 1 if anything differs.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import warnings

import nibabel
import numpy
import pydicom
import SimpleITK

ROOT = pathlib.Path(__file__).resolve().parents[2]
WRITTEN = ["a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.nii", "a.nii.gz"]
# Relative, of spacing and extent: NIfTI-1 and DICOM texts hold no more.
GEOMETRY = 1e-5
VALUES = 1e-6
# Of files with several values a voxel, or several volumes.
COMPONENT = 1


class Image:
    """Values as [z, y, x] and the LPS matrix from (x, y, z) to the world."""

    def __init__(self, values, matrix, origin):
        self.values = numpy.asarray(values, dtype=float)
        self.matrix = numpy.asarray(matrix, dtype=float)
        self.origin = numpy.asarray(origin, dtype=float)

    def corner(self):
        """The world coordinates of the last voxel."""
        last = numpy.array(self.values.shape[::-1]) - 1
        return self.origin + self.matrix @ last[: self.matrix.shape[1]]

    def differences(self, other):
        """Words for what differs."""
        if self.values.shape != other.values.shape:
            return [f"size {self.values.shape[::-1]} and {other.values.shape[::-1]}"]
        found = []
        step = numpy.abs(self.matrix).max()
        gap = max(
            numpy.abs(self.matrix - other.matrix).max() / step,
            numpy.abs(self.origin - other.origin).max() / max(step, numpy.abs(self.origin).max()),
            numpy.abs(self.corner() - other.corner()).max()
            / max(step, numpy.abs(self.corner()).max()),
        )
        if not gap <= GEOMETRY:
            found.append(f"place by {gap:.2g}: {self.origin} {self.matrix.tolist()} and "
                         f"{other.origin} {other.matrix.tolist()}")
        same = (self.values == other.values) | (
            numpy.isnan(self.values) & numpy.isnan(other.values)
        )
        if not same.all():
            largest = max(numpy.nanmax(numpy.abs(self.values)), 1e-300)
            gap = numpy.nanmax(numpy.abs(self.values - other.values)[~same]) / largest
            if not gap <= VALUES:
                found.append(f"values by {gap:.2g} of the largest")
        return found


def from_itk(image):
    """An image of SimpleITK, of which the first three axes lie in space; a picture at z = 0."""
    axes, space = image.GetDimension(), min(image.GetDimension(), 3)
    matrix = numpy.array(image.GetDirection()).reshape(axes, axes) * numpy.array(image.GetSpacing())
    placed, origin = numpy.zeros((3, space)), numpy.zeros(3)
    placed[:space] = matrix[:space, :space]
    origin[:space] = image.GetOrigin()[:space]
    return Image(SimpleITK.GetArrayFromImage(image), placed, origin)


def fitted(image, ours):
    """Our component of several, and our number of axes where there is one slice."""
    values, shape = image.values, ours.values.shape
    if values.ndim > len(shape) and values.shape[1:] == shape:
        values = values[min(COMPONENT, len(values) - 1)]
    elif values.ndim > len(shape) and values.shape[:-1] == shape:
        values = values[..., COMPONENT]
    values = values.reshape(shape) if values.size == ours.values.size else values
    axes = min(image.matrix.shape[1], ours.matrix.shape[1])
    ours.matrix = ours.matrix[:, :axes]
    return Image(values, image.matrix[:, :axes], image.origin)


def read_itk(path):
    """A file, or a folder with a series."""
    if path.is_dir():
        reader = SimpleITK.ImageSeriesReader()
        reader.SetFileNames(reader.GetGDCMSeriesFileNames(str(path)))
        return from_itk(reader.Execute())
    image = SimpleITK.ReadImage(str(path))
    bits = "0028|0100"
    if image.HasMetaDataKey(bits) and image.GetMetaData(bits) == "1":
        # Of single bits it makes 0 and 255.
        return from_itk(image // 255)
    return from_itk(image)


def read_nibabel(path):
    """NIfTI, from RAS."""
    image = nibabel.load(path)
    values = image.get_fdata(dtype=numpy.float64).T
    axes = min(values.ndim, 3)
    affine = numpy.diag([-1.0, -1.0, 1.0, 1.0]) @ image.affine
    return Image(values, affine[:3, :axes], affine[:3, 3])


def said(data, group, name, usual):
    """What a file says of its first frame or of all frames in a functional group, or of itself."""
    for groups in ("PerFrameFunctionalGroupsSequence", "SharedFunctionalGroupsSequence"):
        for frame in data.get(groups, [])[:1]:
            for item in frame.get(group, []):
                if name in item:
                    return item[name].value
    return data.get(name, usual)


def read_pydicom(path):
    """The frames of DICOM, in the plane of the first one."""
    data = pydicom.dcmread(path)
    values = data.pixel_array.astype(float)
    slope = said(data, "PixelValueTransformationSequence", "RescaleSlope", 1)
    values = values * float(slope) + float(
        said(data, "PixelValueTransformationSequence", "RescaleIntercept", 0)
    )
    detector = data.get("ImagerPixelSpacing", [1, 1])
    spacing = said(data, "PixelMeasuresSequence", "PixelSpacing", detector)
    axes = said(data, "PlaneOrientationSequence", "ImageOrientationPatient", [1, 0, 0, 0, 1, 0])
    axes = numpy.array(axes, float).reshape(2, 3)
    matrix = (axes * numpy.array([[float(spacing[1])], [float(spacing[0])]])).T
    position = said(data, "PlanePositionSequence", "ImagePositionPatient", [0, 0, 0])
    return Image(values, matrix, position)


def others(path):
    """The readers that fit, with their names."""
    name = path.name.lower()
    readers = [("SimpleITK", read_itk)]
    if name.endswith((".nii", ".nii.gz", ".hdr", ".hdr.gz")):
        readers.append(("nibabel", read_nibabel))
    if name.endswith(".dcm"):
        readers.append(("pydicom", read_pydicom))
    return readers


def compare_with(readers, path, ours, name):
    """What differs between our image and each reader's, in words."""
    problems = []
    for other, read in readers:
        try:
            image = fitted(read(path), ours)
        except Exception as error:  # The others' refusals are of many kinds.
            print(f"      {other} refuses {name}: {str(error).strip().splitlines()[-1][:150]}")
            continue
        problems += [f"{other}, {name}: {words}" for words in ours.differences(image)]
    return problems


def compare(convert, path, folder):
    """Compares one input; True if all agree or it is refused."""
    def run(output):
        return subprocess.run([convert, path, output, *chosen], capture_output=True, text=True)

    chosen = []
    done = run(folder / "a.nrrd")
    if "choose one component" in done.stderr:
        chosen = [str(COMPONENT)]
        done = run(folder / "a.nrrd")
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        print(f"refused  {path}\n      {done.stderr.strip()}")
        return len(lines) == 1 and "panicked" not in done.stderr
    ours = from_itk(SimpleITK.ReadImage(str(folder / "a.nrrd")))
    problems = compare_with(others(path), path, ours, "the file")
    for name in WRITTEN:
        output = folder / name
        run(output).check_returncode()
        problems += compare_with(others(output), output, ours, name)
    print(f"{'differs' if problems else 'agrees '}  {path} {ours.values.shape[::-1]}")
    for problem in problems:
        print(f"      {problem}")
    return not problems


def inputs(paths):
    """The files given, those in folders, and folders of DICOM."""
    for path in paths:
        if not path.is_dir():
            yield path
            continue
        files = sorted(file for file in path.iterdir() if file.is_file())
        if sum(file.suffix == ".dcm" for file in files) > 1:
            yield path
        yield from files


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="+", type=pathlib.Path)
    parser.add_argument(
        "--convert", default=ROOT / "target/release/examples/convert", help="our reader and writer"
    )
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    SimpleITK.ProcessObject.SetGlobalWarningDisplay(False)
    results = []
    for path in inputs(given.paths):
        with tempfile.TemporaryDirectory() as folder:
            results.append(compare(given.convert, path, pathlib.Path(folder)))
    print(f"{sum(results)} of {len(results)} agree or are refused in one line")
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
