// SPDX-License-Identifier: Apache-2.0
#include "Report/Stroke.h"

#include <algorithm>
#include <cmath>

namespace myotet::report {
namespace {

struct Segment {
    Vec2 from, to;
};

// The share [begin, end] of a segment that is inside a rectangle; begin > end: none.
struct Share {
    double begin = 0, end = 1;

    // Keeps what has offset + t * slope >= 0.
    void keep(double offset, double slope) {
        if (slope > 0)
            begin = std::max(begin, -offset / slope);
        else if (slope < 0)
            end = std::min(end, -offset / slope);
        else if (!(offset >= 0))
            end = -1;
    }
};

Share share_inside(const Segment& s, const Rect& rect) {
    const Vec2 way = s.to - s.from;
    Share share;
    share.keep(s.from.x() - rect.left, way.x());
    share.keep(rect.right - s.from.x(), -way.x());
    share.keep(s.from.y() - rect.top, way.y());
    share.keep(rect.bottom - s.from.y(), -way.y());
    return share;
}

// Where the pen is down on a part of the path, clipped to where it can be seen.
class Tracer {
public:
    Tracer(const Pen& pen, const Rect& seen) : pen_(pen), seen_(seen) {}

    void lift() { gone_ = 0; }

    void trace(const Segment& s) {
        const double length = (s.to - s.from).norm(), start = gone_;
        gone_ += length;
        const Share share = share_inside(s, seen_);
        if (share.begin > share.end) return;
        if (!(pen_.up > 0) || !(length > 0)) {
            add(s, share);
            return;
        }
        const double period = pen_.down + pen_.up;
        const double first = std::floor((start + share.begin * length) / period);
        const double last = std::floor((start + share.end * length) / period);
        for (double k = first; k <= last; ++k) {
            const double begin = (k * period - start) / length;
            add(s, {std::max(share.begin, begin), std::min(share.end, begin + pen_.down / length)});
        }
    }

    [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }

private:
    void add(const Segment& s, const Share& share) {
        if (share.begin > share.end) return;
        const Vec2 way = s.to - s.from;
        segments_.push_back({s.from + share.begin * way, s.from + share.end * way});
    }

    const Pen& pen_;
    Rect seen_;
    double gone_ = 0;  // along the path since its last break, pixels
    std::vector<Segment> segments_;
};

std::vector<Segment> trace(std::span<const Vec2> path, const Pen& pen, const Rect& seen) {
    Tracer tracer(pen, seen);
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (!path[i].allFinite()) continue;
        const bool after = i > 0 && path[i - 1].allFinite();
        const bool before = i + 1 < path.size() && path[i + 1].allFinite();
        if (!after) tracer.lift();
        if (before)
            tracer.trace({path[i], path[i + 1]});
        else if (!after)
            tracer.trace({path[i], path[i]});
    }
    return tracer.segments();
}

// Whole pixels, the ends excluded.
struct Window {
    int left, top, right, bottom;

    [[nodiscard]] bool empty() const { return left >= right || top >= bottom; }
};

// The pixels with their centres inside.
Window window_of(const Rect& r, const Picture& picture) {
    const auto first = [](double side, int most) {
        return static_cast<int>(std::ceil(std::clamp(side, 0.0, double(most)) - 0.5));
    };
    return {first(r.left, picture.width), first(r.top, picture.height),
            first(r.right, picture.width), first(r.bottom, picture.height)};
}

Window around(const Segment& s, double reach, const Window& limit) {
    const Vec2 low = s.from.cwiseMin(s.to).array() - reach;
    const Vec2 high = s.from.cwiseMax(s.to).array() + reach;
    const auto whole = [](double side, int least, int most) {
        return static_cast<int>(std::clamp(side, double(least), double(most)));
    };
    return {whole(std::floor(low.x()), limit.left, limit.right),
            whole(std::floor(low.y()), limit.top, limit.bottom),
            whole(std::ceil(high.x()), limit.left, limit.right),
            whole(std::ceil(high.y()), limit.top, limit.bottom)};
}

double distance(const Vec2& p, const Segment& s) {
    const Vec2 way = s.to - s.from;
    const double square = way.squaredNorm();
    const double t = square > 0 ? std::clamp((p - s.from).dot(way) / square, 0.0, 1.0) : 0.0;
    return (s.from + t * way - p).norm();
}

// The covered shares of a window's pixels.
struct Cover {
    explicit Cover(const Window& w)
        : window(w),
          shares(static_cast<std::size_t>(w.right - w.left) * (w.bottom - w.top), 0.0F) {}

    [[nodiscard]] float& at(int x, int y) {
        return shares[static_cast<std::size_t>(y - window.top) * (window.right - window.left) +
                      (x - window.left)];
    }

    void add(const Segment& s, double width) {
        const Window part = around(s, 0.5 * width + 1, window);
        for (int y = part.top; y < part.bottom; ++y)
            for (int x = part.left; x < part.right; ++x) {
                const double d = distance({x + 0.5, y + 0.5}, s);
                const auto share = static_cast<float>(std::clamp(0.5 * width + 0.5 - d, 0.0, 1.0));
                at(x, y) = std::max(at(x, y), share);
            }
    }

    Window window;
    std::vector<float> shares;
};

void blend(Picture& picture, Cover& cover, const Colour& colour) {
    const Window& w = cover.window;
    for (int y = w.top; y < w.bottom; ++y)
        for (int x = w.left; x < w.right; ++x) {
            const double share = cover.at(x, y);
            if (!(share > 0)) continue;
            const std::size_t at = picture.offset(x, y);
            Colour mixed;
            for (int c = 0; c < 3; ++c)
                mixed[c] = (1 - share) * picture.rgb[at + c] / 255 + share * colour[c];
            set_pixel(picture, x, y, mixed);
        }
}

}  // namespace

void draw_path(Picture& picture, std::span<const Vec2> path, const Pen& pen) {
    const Window window = window_of(pen.clip, picture);
    if (window.empty()) return;
    const double reach = pen.width + 1;
    const Rect seen{window.left - reach, window.top - reach, window.right + reach,
                    window.bottom + reach};
    const std::vector<Segment> segments = trace(path, pen, seen);
    Window used{window.right, window.bottom, window.left, window.top};
    for (const Segment& s : segments) {
        const Window w = around(s, reach, window);
        used = {std::min(used.left, w.left), std::min(used.top, w.top),
                std::max(used.right, w.right), std::max(used.bottom, w.bottom)};
    }
    if (used.empty()) return;
    Cover cover(used);
    for (const Segment& s : segments) cover.add(s, pen.width);
    blend(picture, cover, pen.colour);
}

}  // namespace myotet::report
