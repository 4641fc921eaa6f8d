// Paths of heatpath as lines of VTK.
#ifndef LINE_H
#define LINE_H

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <heatpath.hpp>

#include <stdexcept>
#include <string>

inline void write(vtkPolyData *data, const std::string &name)
{
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName(name.c_str());
    writer->SetDataModeToAscii();
    if (!writer->Write())
        throw std::runtime_error(name + " cannot be written");
}

inline void write_line(const heatpath::Points<3> &path, const std::string &name)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(static_cast<vtkIdType>(path.size()));
    for (const heatpath::Point<3> &point : path)
        lines->InsertCellPoint(points->InsertNextPoint(point.data()));
    vtkNew<vtkPolyData> curve;
    curve->SetPoints(points);
    curve->SetLines(lines);
    write(curve, name);
}

#endif
