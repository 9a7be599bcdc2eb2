// SPDX-License-Identifier: Apache-2.0
#include "Contraction/TimeSeries.h"

#include <algorithm>
#include <cmath>

#include "Contraction/Words.h"
#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

std::string title_of(const Column& column) {
    return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

std::string title_line(const History& history, const fs::path& file) {
    std::string line;
    for (std::size_t c = 0; c < history.columns.size(); ++c) {
        const std::string title = title_of(history.columns[c]);
        if (title.empty() || title.find_first_of(",;\t\"\r\n") != std::string::npos)
            throw InputError(file.string() + ": the column '" + title +
                             "' has no name that a table of commas can hold; rename it");
        for (std::size_t other = 0; other < c; ++other)
            if (title_of(history.columns[other]) == title)
                throw InputError(file.string() + ": two columns are named '" + title +
                                 "'; rename one");
        line += (c ? "," : "") + title;
    }
    return line + "\n";
}

}  // namespace

void write_pvd(std::span<const TimedFile> frames, const fs::path& file) {
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    int part = 0;  // of the same time
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const TimedFile& frame = frames[f];
        if (!std::isfinite(frame.time) || (f > 0 && !(frame.time >= frames[f - 1].time)))
            throw InputError(file.string() + ": frame " + std::to_string(f) + " is at " +
                             shown(frame.time) + " s, but times must not descend");
        part = f > 0 && frame.time == frames[f - 1].time ? part + 1 : 0;
        if (frame.file.empty())
            throw InputError(file.string() + ": frame " + std::to_string(f) +
                             " has no file; name one");
        text += "    <DataSet timestep=\"" + shown(frame.time) + "\" group=\"\" part=\"" +
                std::to_string(part) + "\" file=\"" +
                meshfiles::xml_escaped(frame.file.generic_string()) + "\"/>\n";
    }
    write_atomically(file, text + "  </Collection>\n</VTKFile>\n");
}

void write_history(const History& history, const fs::path& file) {
    std::string text = title_line(history, file);
    for (std::size_t r = 0; r < history.rows.size(); ++r) {
        const std::vector<double>& row = history.rows[r];
        if (row.size() != history.columns.size())
            throw InputError(file.string() + ": row " + std::to_string(r) + " has " +
                             std::to_string(row.size()) + " numbers for " +
                             std::to_string(history.columns.size()) + " columns");
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (!std::isfinite(row[c]))
                throw InputError(file.string() + ": row " + std::to_string(r) + " of column '" +
                                 history.columns[c].name + "' is " + shown(row[c]) +
                                 " but must be a finite number");
            text += (c ? "," : "") + shown(row[c]);
        }
        text += "\n";
    }
    write_atomically(file, text);
}

}  // namespace myotet::contraction
