// SPDX-License-Identifier: Apache-2.0
#include "Report/Viewer.h"

#include "Report/Deflate.h"
#include "Report/Html.h"
#include "Report/ViewerPack.h"
#include "Report/ViewerProgram.h"

namespace myotet::report {
namespace {

// Unpacks the program and runs it; says why where it cannot.
constexpr std::string_view kLoader = R"js(
(function () {
  "use strict";
  var place = document.getElementById("viewer");
  function say(why) {
    place.setAttribute("data-state", "failed");
    place.textContent = "The 3D view cannot be shown: " + why + ". Pictures follow below.";
  }
  if (!window.DecompressionStream) return say("this browser is too old for it");
  var text = atob(document.getElementById("viewer-program").textContent);
  var bytes = Uint8Array.from(text, function (c) { return c.charCodeAt(0); });
  var stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  new Response(stream).text().then(function (program) {
    var script = document.createElement("script");
    script.textContent = program;
    document.head.appendChild(script);
  }).catch(function (failure) { say(failure.message); });
})();
)js";

std::string script(std::string_view kind, std::string_view id, std::string_view content) {
    return "<script type=\"" + std::string(kind) + "\" id=\"" + std::string(id) + "\">" +
           std::string(content) + "</script>\n";
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string text;
    for (const std::string& sentence : sentences) text += (text.empty() ? "" : " ") + sentence;
    return text;
}

constexpr std::string_view kGestures =
    "Drag to turn, with Shift to move, pinch to zoom; after a click on the picture the wheel "
    "zooms. "
    "With the keyboard: arrows, Shift and arrows, + and \xE2\x88\x92, 0.";

}  // namespace

bool has_viewer() { return !kViewerProgram.empty(); }

std::string viewer_html(const ViewedScene& scene) {
    if (scene.bodies.empty()) return paragraph(joined(scene.notes));
    if (!has_viewer())
        return paragraph(
            "This Myotet was built without Node.js and npm, so that its pages have no 3D view. "
            "Pictures, tables and plots follow.");
    const PackedScene made = packed(scene);
    return "<div class=\"viewer\" id=\"viewer\" data-state=\"waiting\"><p>The 3D view needs "
           "scripts to be allowed. Pictures follow below.</p></div>\n<div class=\"for-screens\">" +
           paragraph(kGestures) + paragraph(joined(scene.notes)) + "</div>\n" +
           script("application/json", "viewer-scene", made.header) +
           script("text/plain", "viewer-data", base64(deflated(made.data))) +
           script("text/plain", "viewer-program", kViewerProgram) + "<script>" +
           std::string(kLoader) +
           "</script>\n<details class=\"licences\"><summary>Licences of what draws the 3D "
           "view</summary><pre>" +
           escaped(kViewerNotices) + "</pre></details>\n";
}

}  // namespace myotet::report
