// Snippets: the script and the commands that repeat what a screen shows.

/**
 * What a screen shows. A screen may state `python` and `shell` itself; `name` is of a job, run, study or reduced model.
 * @typedef {{screen: string, name?: string, job?: string, study?: string, kind?: string, folder?: string, python?: string, shell?: string, inputs?: any[], options?: string[]}} Seen
 */

/** A text for Python. @param {string} text */
const quoted = (text) => JSON.stringify(text);
/** A word for the shell. @param {string} text */
const word = (text) => (/^[\w./:=+-]+$/.test(text) ? text : `'${text.replaceAll("'", `'\\''`)}'`);
/** A path with another ending. @param {string} name @param {string} ending */
const withEnding = (name, ending) => name.replace(/\.toml$/, "") + ending;

/** @type {Record<string, (seen: Seen) => {python: string, shell: string}>} */
const OF = {
  start: () => ({
    python: "from pathlib import Path\n\nPath(\"finger.toml\").write_text(tg.jobs.starter(\"fast_pneunet\"), encoding=\"utf-8\")",
    shell: "turgor init                          # lists the families\nturgor init fast_pneunet -o finger.toml",
  }),
  shape: ({ job = "" }) => ({
    python: `job = tg.jobs.read_job(${quoted(job)})\ngeometry = job.geometry()\nprint(geometry.regions, geometry.faces)`,
    shell: `turgor inspect ${word(job)}\nturgor mesh ${word(job)}`,
  }),
  setup: ({ job = "" }) => ({
    python: `job = tg.jobs.read_job(${quoted(job)})\nmodel, findings = tg.jobs.prepare(job)\nprint(model.supports, model.loads)\nfor finding in findings:\n    print(finding)`,
    shell: `turgor check ${word(job)}`,
  }),
  solve: ({ job = "" }) => ({
    python: `job = tg.jobs.read_job(${quoted(job)})\noutcome = tg.jobs.run_job(job, ${quoted(withEnding(job, "-results"))})`,
    shell: `turgor check ${word(job)}\nturgor run ${word(job)} -o ${word(withEnding(job, "-results"))}`,
  }),
  look: ({ name = "" }) => ({
    python: `solution = tg.load(${quoted(name)})\nresponse = tg.measure(solution)\nprint(response)\ntg.pictures.viewer(solution, response=response).save("viewer.html")`,
    shell: `turgor measure ${word(name)}\nturgor report ${word(name)}`,
  }),
  decide: ({ job = "", study, kind = "sweep", folder = "" }) =>
    study
      ? {
          python: kind === "sweep" ? `study = tg.studies.load_study(${quoted(folder)})\nprint(study)` : `study = tg.studies.read_study_file(${quoted(study)})\nprint(study)`,
          shell: `turgor ${kind} ${word(study)}`,
        }
      : {
          python: `job = tg.jobs.read_job(${quoted(job)})  # the form writes a study of it, a file of its own\nprint(job)`,
          shell: `turgor check ${word(job)}\n# then the study that the form has written: turgor sweep STUDY.toml`,
        },
  materials: ({ job = "" }) => ({
    python: `job = tg.jobs.read_job(${quoted(job)})\nfor region, material in job.materials.items():\n    print(region, material)`,
    shell: "turgor materials list\nturgor materials plot ecoflex-00-30\nturgor fit tests.csv --laws yeoh,gent -o fits",
  }),
  live: ({ name = "", inputs = [] }) => {
    const known = inputs.filter((each) => each.factor !== 1).map((each) => each.unit);
    const units = [...new Set(known)].map((unit) => (/^\w+$/.test(unit) ? unit : ""));
    const value = (/** @type {any} */ each) => (each.factor !== 1 && /^\w+$/.test(each.unit) ? `${each.value} * ${each.unit}` : String(each.value * each.factor));
    const at = inputs.map((each) => `    ${quoted(each.key)}: ${value(each)},\n`).join("");
    const options = inputs.map((each) => ` \\\n  --at ${word(`${each.key}=${each.value}${each.factor !== 1 ? ` ${each.unit}` : ""}`)}`).join("");
    const used = units.filter(Boolean);
    return {
      python: `${used.length ? `from turgor.units import ${used.join(", ")}\n\n` : ""}reduced = tg.load(${quoted(name)})\nanswer = reduced.solve({\n${at}})\nprint(answer.tip, answer.volumes, answer.estimate)\nfor reading in tg.real_time.readings(answer):\n    print(reading.words, reading.text)`,
      shell: `turgor predict ${word(name)}${options}\nturgor live ${word(name)}`,
    };
  },
};

/** The script and the commands for what was seen. @param {Seen} seen */
export function codeOf(seen) {
  const made = (OF[seen.screen] ?? OF.start)(seen);
  const body = seen.python ?? made.python;
  return { python: /^import turgor/m.test(body) ? body : `import turgor as tg\n${body.startsWith("from ") ? "" : "\n"}${body}\n`, shell: `${seen.shell ?? made.shell}\n` };
}
