// SPDX-License-Identifier: Apache-2.0
#include "ReportJob.h"

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Core/Text.h"
#include "ExitCodes.h"
#include "Pages.h"
#include "Report/Page.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

enum class Kind { mesh, contract, activate, press };

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw InputError(file.string() + ": " + why);
}

Kind kind_of(const RunJson& run, const fs::path& file) {
    if (run.contains("scene") && run.contains("bodies")) return Kind::contract;
    if (run.contains("organ") && run.contains("tool")) return Kind::press;
    if (run.contains("model") && run.contains("muscles")) return Kind::activate;
    if (run.contains("tissues") && run.at("tissues").is_array() && !run.at("tissues").empty() &&
        run.at("tissues").front().contains("tets"))
        return Kind::mesh;
    refuse(file,
           "is of a run that has no page; pages are made of the results of mesh, contract, "
           "press and activate");
}

RunJson read_run(const fs::path& file) {
    if (std::error_code failed; !fs::is_regular_file(file, failed))
        refuse(file, "is not there; name a folder of results of mesh, contract, press or activate");
    RunJson run;
    try {
        run = RunJson::parse(read_whole(file));
    } catch (const RunJson::exception&) {
        refuse(file, "is damaged: it is no JSON; make the results again");
    }
    if (!run.is_object() || !run.contains("version") || !run.at("version").is_string())
        refuse(file, "is no report of a run of Myotet, since it says no version");
    if (const std::string version = text_of(run, "version"); version != MYOTET_VERSION)
        refuse(file, "was written by version " + version +
                         ", but this is version " MYOTET_VERSION
                         "; make the results again, or use that version");
    return run;
}

report::Page make_page(const RunJson& run, Kind kind, const MeshViews& views,
                       const fs::path& folder) {
    if (kind == Kind::contract) return contract_page(run, folder);
    if (kind == Kind::press) return press_page(run, folder);
    if (kind == Kind::activate) return activate_page(run, folder);
    return mesh_page(run, views);
}

}  // namespace

void run_report_job(const ReportJobOptions& options, ProgressSink& progress) {
    const fs::path file = options.folder / "report.json";
    const RunJson run = read_run(file);
    progress.report("report", 0);
    try {
        const Kind kind = kind_of(run, file);
        if (options.png && kind != Kind::mesh)
            throw UsageError("--png draws tissues, which only results of mesh have; leave it out");
        MeshViews views;
        if (kind == Kind::mesh) views = read_views(run, options.folder, progress);
        const std::string page = report::to_html(make_page(run, kind, views, options.folder));
        progress.check();
        if (options.png) write_pictures(views, options.folder);
        write_atomically(options.folder / kPageFile, page);
    } catch (const RunJson::exception& wrong) {
        refuse(file, "is damaged: " + std::string(wrong.what()) + "; make the results again");
    }
    progress.report("report", 1);
}

void add_page(const fs::path& folder, bool wanted, ProgressSink& progress) {
    std::error_code ignored;
    if (!wanted) {
        fs::remove(folder / kPageFile, ignored);
        return;
    }
    try {
        run_report_job({.folder = folder}, progress);
    } catch (const Interrupted&) {
        throw;
    } catch (const Error& failure) {
        fs::remove(folder / kPageFile, ignored);
        progress.warn(std::string("no page was made of the results: ") + failure.what());
    }
}

}  // namespace myotet::app
