// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "Report/Chart.h"
#include "Report/Histogram.h"

namespace myotet::report {

/// A panel of lines as a figure of a page: title, legend, drawing; the first eight lines have
/// the page's colours `line-0` to `line-7`, further ones the same again, dashed. A y that is
/// not finite breaks its line. Throws InputError as draw_chart.
[[nodiscard]] std::string chart_figure(const Panel& panel, const std::string& x_label);

/// A histogram as a figure of a page; numbers that are not finite are told below it.
[[nodiscard]] std::string histogram_figure(const Histogram& histogram, const std::string& title,
                                           const std::string& x_label);

}  // namespace myotet::report
