// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/OneHot.h"

#include <algorithm>

#include "Core/Errors.h"

namespace myotet::segmentation {

void OneHot::take(const std::vector<std::int32_t>& values) {
    ++taken_;
    std::vector<std::uint8_t> mask(values.size());
    std::int32_t inside = 0;
    for (std::size_t n = 0; n < values.size(); ++n) {
        if (values[n] == 0) continue;
        if (inside == 0) inside = values[n];
        if (values[n] != inside)
            throw InputError(file_.string() + ": volume " + std::to_string(taken_) +
                             " holds the values " + std::to_string(inside) + " and " +
                             std::to_string(values[n]) +
                             ", but each volume of a one-hot file is the mask of one label; read "
                             "it without --one-hot, or export masks of 0 and 1");
        mask[n] = 1;
    }
    if (inside == 0) {
        empty_ += (empty_.empty() ? "" : ", ") + std::to_string(taken_);
        return;
    }
    const MaskRun whole{0, mask};
    (void)packer_.add(taken_, {&whole, 1});
}

std::vector<LabelVolume> OneHot::finish(const Eigen::Affine3d& index_to_lps,
                                        const std::map<std::int32_t, LabelName>& names,
                                        std::vector<std::string>& warnings) {
    if (!empty_.empty())
        warnings.push_back(file_.string() + ": no voxel is set in volume " + empty_ +
                           ", so there is no such label.");
    return packer_.finish(index_to_lps, names);
}

}  // namespace myotet::segmentation
