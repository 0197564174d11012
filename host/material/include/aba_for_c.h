/* SPDX-License-Identifier: BSD-3-Clause */
#include <omi_for_c.h>
