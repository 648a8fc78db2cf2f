// SPDX-License-Identifier: Apache-2.0
#include "ground/surface.h"

#include <gtest/gtest.h>
