// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "LevelSet/CsgPieces.h"
#include "LevelSet/CsgTable.h"
#include "Repair/Steps.h"

namespace myotet::repair {
namespace {

using levelset::Band;
using levelset::Pieces;

Band reshaped(const Band& band, Change how, double by) {
    if (how == Change::open) return levelset::opened(band, by);
    if (how == Change::close) return levelset::closed(band, by);
    return levelset::offset(band, by);
}

std::string counted(std::size_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// Takes marked pieces away, or fills them.
void flip(int tissue, const Pieces& pieces, const std::vector<char>& marked,
          const std::vector<int>& givers, Workshop& shop) {
    const auto count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
    const bool islands = pieces.side == levelset::Side::inside;
    const std::string note =
        islands ? counted(count, "island") + " dropped" : counted(count, "hollow") + " filled";
    if (count == 0) {
        shop.replace(tissue, shop.band(tissue), {}, note);
        return;
    }
    Band form = levelset::flip_pieces(levelset::framed(shop.band(tissue), 1), pieces, marked);
    if (!islands) form = shop.yield(tissue, form, givers);
    shop.replace(tissue, std::move(form), givers, note);
}

}  // namespace

void run(const Reshape& task, Workshop& shop) {
    const std::vector<int> givers = shop.find_all(task.takes_from);
    for (const int tissue : shop.find_all(task.tissues)) {
        Band form = reshaped(shop.band(tissue), task.how, task.by);
        if (task.how == Change::close || task.by > 0) form = shop.yield(tissue, form, givers);
        shop.replace(tissue, std::move(form), givers);
    }
}

void run(const KeepLargest& task, Workshop& shop) {
    for (const int tissue : shop.find_all(task.tissues)) {
        const Pieces pieces =
            levelset::find_pieces(levelset::framed(shop.band(tissue), 1), levelset::Side::inside);
        std::vector<char> marked(pieces.volume.size(), 1);
        for (std::size_t p = 0; p < std::min(marked.size(), std::size_t(task.count)); ++p)
            marked[p] = 0;
        flip(tissue, pieces, marked, {}, shop);
    }
}

void run(const DropIslands& task, Workshop& shop) {
    for (const int tissue : shop.find_all(task.tissues)) {
        const Pieces pieces =
            levelset::find_pieces(levelset::framed(shop.band(tissue), 1), levelset::Side::inside);
        std::vector<char> marked(pieces.volume.size(), 0);
        for (std::size_t p = 0; p < marked.size(); ++p) marked[p] = pieces.volume[p] < task.under;
        flip(tissue, pieces, marked, {}, shop);
    }
}

void run(const FillCavities& task, Workshop& shop) {
    const std::vector<int> givers = shop.find_all(task.takes_from);
    for (const int tissue : shop.find_all(task.tissues)) {
        const Pieces pieces =
            levelset::find_pieces(levelset::framed(shop.band(tissue), 1), levelset::Side::outside);
        std::vector<char> marked(pieces.volume.size(), 0);
        for (std::size_t p = 1; p < marked.size(); ++p) marked[p] = pieces.volume[p] < task.under;
        flip(tissue, pieces, marked, givers, shop);
    }
}

}  // namespace myotet::repair
