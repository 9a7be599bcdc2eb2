// SPDX-License-Identifier: Apache-2.0
#include "ViewerScenes.h"

namespace myotet::app {

report::Section view_section(const ViewerScene& viewer) {
    std::string html = viewer.scene.bodies.empty() ? "" : report::viewer_html(viewer.scene);
    if (viewer.scene.bodies.empty() || report::has_viewer()) {
        std::string said;
        for (const std::string& note : viewer.notes) said += (said.empty() ? "" : " ") + note;
        html += "<div class=\"for-screens\">" + report::paragraph(said);
        if (!viewer.scene.bodies.empty())
            html += report::paragraph(
                "Drag to turn, with Shift to move, pinch to zoom; click on the picture and the "
                "wheel zooms. With the keyboard: arrows, Shift and arrows, + and \xE2\x88\x92, 0.");
        html += "</div>\n";
    }
    return {"view", "3D view", html};
}

}  // namespace myotet::app
