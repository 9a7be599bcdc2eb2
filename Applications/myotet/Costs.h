// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "Core/AtomicFile.h"
#include "Machine.h"
#include "Outputs.h"

namespace myotet::app {

/// Into a report: what its run has cost so far.
template <class Report>
void note_costs(Report& report) {
    report.peak_memory = peak_memory();
    report.processor_seconds = processor_seconds();
}

/// What report.json tells of costs and of what went on.
template <class Report>
void add_costs(nlohmann::ordered_json& json, const Report& report) {
    json["seconds"] = report.seconds;
    json["processor_seconds"] = report.processor_seconds;
    json["peak_memory_bytes"] = report.peak_memory;
    json["warnings"] = report.warnings;
}

/// The last file of a run: its report.
template <class Report>
void write_report(OutputFolder& out, const Report& report) {
    out.write("report.json",
              [&](const std::filesystem::path& file) { write_atomically(file, to_json(report)); });
}

}  // namespace myotet::app
