// SPDX-License-Identifier: Apache-2.0
// Stands where the writers through ITK stand; a reader that came here would be wrong.
#include "Core/Errors.h"
#include "Segmentation/ItkImage.h"

namespace myotet::segmentation {

void write_itk(const LabelVolume&, const std::filesystem::path&, ItkFormat,
               const std::map<std::string, std::string>&) {
    throw LogicError("a reader writes");
}

}  // namespace myotet::segmentation
