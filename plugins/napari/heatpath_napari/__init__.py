"""heatpath in napari: `widgets`, and `library`, which needs numpy alone."""
