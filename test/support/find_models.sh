#!/bin/sh
# Whether the models are there that tests need and the project does not ship; 77 if not.
# Usage: find_models.sh SOURCE_FOLDER
# SPDX-License-Identifier: BSD-3-Clause
folder="${FCL_PROB_MODELS:-$1/../shared/models}"
[ -d "$folder" ] && exit 0
echo "SKIPPED: tests that need the models of $folder; set FCL_PROB_MODELS"
exit 77
