"""What all rules share."""


include: "common/begin.smk"
include: "common/study.smk"
include: "common/depends.smk"
include: "common/lookup.smk"
include: "common/inputs.smk"
include: "common/outputs.smk"
include: "common/whole.smk"
