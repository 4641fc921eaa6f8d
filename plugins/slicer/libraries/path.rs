//! A command line module of 3D Slicer that is loaded, see `heatpath_slicer`.

#![allow(unsafe_code, reason = "hosts ask for symbols by name")]
#![allow(non_snake_case, non_upper_case_globals, reason = "Slicer gives the names")]

heatpath_slicer::shared_object!(
    heatpath_slicer::modules::PATH,
    include_bytes!(concat!(env!("OUT_DIR"), "/HeatpathPath.xml"))
);
