// SPDX-License-Identifier: Apache-2.0
#include "Report/ViewerPack.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "Report/ColourMap.h"
#include "Report/Html.h"
#include "Report/TetCode.h"

namespace myotet::report {
namespace {

constexpr double kMostSteps = 65535;  // of a coordinate across a body's box
constexpr double kValueSteps = 254;   // of a value between its limits
constexpr unsigned char kNoValue = 255;
constexpr std::size_t kMostFibres = 3000;  // of a body
constexpr int kRampColours = 9;

using Whole = std::array<std::int32_t, 3>;

void require(bool holds, const ViewedBody& body, const char* what) {
    if (!holds)
        throw InputError("the viewer's body '" + body.name + "' has not as many " + what +
                         " as its mesh; give one each");
}

std::string list(std::initializer_list<double> numbers) {
    std::string text = "[";
    for (const double number : numbers) text += (text.size() > 1 ? "," : "") + shown(number);
    return text + "]";
}

std::string corner_text(const Vec3& p) { return list({p[0], p[1], p[2]}); }

// Appends to the data and says where that is.
std::string placed(std::string& data, std::string_view bytes) {
    const auto begin = static_cast<double>(data.size());
    data += bytes;
    return list({begin, static_cast<double>(bytes.size())});
}

std::vector<Whole> rounded_points(const std::vector<Vec3>& points,
                                  const std::vector<std::int32_t>& order, const Box& box) {
    std::vector<Whole> whole;
    for (const std::int32_t old : order) {
        Whole p;
        for (int i = 0; i < 3; ++i) {
            const double extent = box.max[i] - box.min[i];
            const double share = extent > 0 ? (points[old][i] - box.min[i]) / extent : 0;
            p[i] = static_cast<std::int32_t>(std::lround(kMostSteps * share));
        }
        whole.push_back(p);
    }
    return whole;
}

std::int32_t guessed(const std::vector<Whole>& whole, const Guess& guess, int axis) {
    if (guess.a < 0) return 0;
    if (guess.b < 0) return whole[guess.a][axis];
    const std::int32_t sum = whole[guess.a][axis] + whole[guess.b][axis] + whole[guess.c][axis];
    return 2 * sum / 3 - whole[guess.d][axis];
}

// Differences modulo 65536 with their sign in the lowest bit: all low bytes, then all high ones.
void append_differences(std::string& bytes, const std::vector<std::int32_t>& differences) {
    std::string low, high;
    for (const std::int32_t difference : differences) {
        const auto small = static_cast<std::int16_t>(static_cast<std::uint16_t>(difference));
        const auto coded = static_cast<std::uint16_t>((small << 1) ^ (small >> 15));
        low += static_cast<char>(coded & 255);
        high += static_cast<char>(coded >> 8);
    }
    bytes += low + high;
}

std::string coordinate_bytes(const std::vector<std::vector<Vec3>>& moments, const Connections& told,
                             const Box& box) {
    std::string bytes;
    std::vector<Whole> before;
    for (const std::vector<Vec3>& points : moments) {
        std::vector<Whole> whole = rounded_points(points, told.points, box);
        std::vector<std::int32_t> differences;
        for (std::size_t p = 0; p < whole.size(); ++p)
            for (int i = 0; i < 3; ++i)
                differences.push_back(whole[p][i] - (before.empty()
                                                         ? guessed(whole, told.guesses[p], i)
                                                         : before[p][i]));
        append_differences(bytes, differences);
        before = std::move(whole);
    }
    return bytes;
}

// The bytes' differences from the time before, at first from the neighbour.
std::string value_bytes(const ViewedValues& values, const ViewedQuantity& quantity,
                        const std::vector<std::int32_t>& order) {
    const double range = std::max(quantity.most - quantity.least, 1e-300);
    std::string bytes;
    std::vector<unsigned char> before;
    for (const std::vector<double>& numbers : values.times) {
        std::vector<unsigned char> now;
        for (const std::int32_t old : order) {
            const double share = (numbers[old] - quantity.least) / range;
            now.push_back(std::isfinite(share) ? static_cast<unsigned char>(std::lround(
                                                     kValueSteps * std::clamp(share, 0.0, 1.0)))
                                               : kNoValue);
        }
        for (std::size_t i = 0; i < now.size(); ++i) {
            const int guess = !before.empty() ? before[i] : i > 0 ? now[i - 1] : 0;
            bytes += static_cast<char>(now[i] - guess);
        }
        before = std::move(now);
    }
    return bytes;
}

std::string values_text(const ViewedScene& scene, const ViewedBody& body, const Connections& told,
                        std::string& data) {
    std::string text;
    for (const ViewedValues& values : body.values) {
        const bool at_tets = values.at == ViewedValues::At::tets;
        const auto& order = at_tets ? told.elements : told.points;
        const std::size_t count = at_tets                  ? body.mesh.tets.size()
                                  : body.mesh.tets.empty() ? body.surface.points.size()
                                                           : body.mesh.points.size();
        require(values.quantity < scene.quantities.size() && !values.times.empty(), body, "values");
        for (const std::vector<double>& numbers : values.times)
            require(numbers.size() == count, body, "values");
        text += std::string(text.empty() ? "" : ",") +
                "{\"quantity\":" + std::to_string(values.quantity) + ",\"at\":\"" +
                (at_tets ? "tets" : "points") + "\",\"bytes\":" +
                placed(data, value_bytes(values, scene.quantities[values.quantity], order)) +
                ",\"times\":" + std::to_string(values.times.size()) + "}";
    }
    return "[" + text + "]";
}

std::string fibres_text(const ViewedBody& body, const Connections& told, std::string& data) {
    if (body.fibres.empty()) return "null";
    const std::size_t count = told.elements.size();
    const std::size_t step = std::max<std::size_t>(1, (count + kMostFibres - 1) / kMostFibres);
    std::string bytes;
    for (const std::vector<Vec3>& directions : body.fibres) {
        require(directions.size() == count, body, "fibres");
        for (std::size_t t = 0; t < count; t += step)
            for (int i = 0; i < 3; ++i)
                bytes += static_cast<char>(
                    std::lround(127 * std::clamp(directions[told.elements[t]][i], -1.0, 1.0)));
    }
    return "{\"step\":" + std::to_string(step) + ",\"bytes\":" + placed(data, bytes) + "}";
}

std::string body_text(const ViewedScene& scene, const ViewedBody& body, std::string& data) {
    const bool solid = !body.mesh.tets.empty();
    const std::vector<Vec3>& points = solid ? body.mesh.points : body.surface.points;
    std::vector<std::vector<Vec3>> moments = body.moments;
    if (moments.empty()) moments.push_back(points);
    const Connections told = solid ? tell_tets(body.mesh.tets, points.size())
                                   : tell_triangles(body.surface.triangles, points.size());
    Box box;
    for (const std::vector<Vec3>& moment : moments) {
        require(moment.size() == points.size(), body, "points");
        for (const std::int32_t old : told.points) box.include(moment[old]);
    }
    if (told.points.empty()) box = {Vec3::Zero(), Vec3::Zero()};
    const std::size_t tets = solid ? told.elements.size() : 0;
    std::string text = "{\"name\":" + json_text(body.name) + ",\"colour\":\"" +
                       css_colour(body.colour) +
                       "\",\"points\":" + std::to_string(told.points.size()) +
                       ",\"tets\":" + std::to_string(tets) +
                       ",\"triangles\":" + std::to_string(told.elements.size() - tets) +
                       ",\"least\":" + corner_text(box.min) + ",\"most\":" + corner_text(box.max);
    text += ",\"connectivity\":" + placed(data, told.bytes);
    text += ",\"coordinates\":" + placed(data, coordinate_bytes(moments, told, box));
    text += ",\"moments\":" + std::to_string(moments.size());
    text += ",\"values\":" + values_text(scene, body, told, data);
    return text + ",\"fibres\":" + (solid ? fibres_text(body, told, data) : "null") + "}";
}

}  // namespace

PackedScene packed(const ViewedScene& scene) {
    PackedScene made;
    std::string bodies, quantities, times, ramp;
    const auto add = [](std::string& to, const std::string& what) {
        to += (to.empty() ? "" : ",") + what;
    };
    for (const ViewedBody& body : scene.bodies) add(bodies, body_text(scene, body, made.data));
    for (const ViewedQuantity& quantity : scene.quantities)
        add(quantities, "{\"name\":" + json_text(quantity.name) + ",\"least\":" +
                            shown(quantity.least) + ",\"most\":" + shown(quantity.most) + "}");
    for (const double time : scene.times) add(times, shown(time));
    for (int i = 0; i < kRampColours; ++i)
        add(ramp, "\"" + css_colour(map_colour(i / (kRampColours - 1.0))) + "\"");
    made.header = "{\"bodies\":[" + bodies + "],\n\"quantities\":[" + quantities +
                  "],\n\"times\":[" + times + "],\n\"ramp\":[" + ramp + "]}";
    return made;
}

}  // namespace myotet::report
