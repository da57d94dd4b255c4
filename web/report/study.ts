// SPDX-License-Identifier: Apache-2.0
/** The page of a study. */
import type { StudyData } from "./data";
import { show } from "./page";
import { studyPage } from "./study_page";

void show<StudyData>(studyPage);
