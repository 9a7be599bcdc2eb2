// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Repair/Workshop.h"

namespace myotet::repair {

/// Each does one step of a recipe.
void run(const Combine& task, Workshop& shop);
void run(const Create& task, Workshop& shop);
void run(const Reshape& task, Workshop& shop);
void run(const KeepLargest& task, Workshop& shop);
void run(const DropIslands& task, Workshop& shop);
void run(const FillCavities& task, Workshop& shop);
void run(const Clip& task, Workshop& shop);
void run(const Join& task, Workshop& shop);
void run(const Grow& task, Workshop& shop);
void run(const Priority& task, Workshop& shop);

}  // namespace myotet::repair
