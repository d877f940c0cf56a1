// Numbers: values with their mesh errors as text, and names of measures in words.

/** @param {string} name */
export const words = (name) => name.replaceAll("_", " ").replace("von mises", "von Mises stress").replace(" p99", " (99 % of volume)");

/** Signs of units, where they differ from those in files. @type {Record<string, string>} */
const SIGNS = { deg: "°", um: "µm", m2: "m²", mm2: "mm²", m3: "m³", Nm: "N m", m3s: "m³/s" };

/** @param {string} unit */
export const sign = (unit) => SIGNS[unit] ?? unit;

/** Name and unit of a column, as an axis shows it. @param {{name: string, unit: string}} column */
export const label = (column) => (column.unit ? `${words(column.name)} [${sign(column.unit)}]` : words(column.name));

/** A number with some digits. @param {number | null | undefined} value @param {number} [digits] */
export function written(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e-3 && size < 1e6 ? String(Number(value.toPrecision(digits))) : value.toPrecision(digits);
  return text.replace("-", "−");
}

/**
 * A value with its mesh error, with as many digits as the error allows to tell apart.
 * @param {number | null | undefined} value @param {number | null | undefined} error @param {string} unit
 */
export function withError(value, error, unit) {
  const end = unit ? ` ${sign(unit)}` : "";
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (!error || !Number.isFinite(error) || error <= 0 || error < 1e-6) return written(value) + end;
  const place = Math.floor(Math.log10(error));
  const leading = error / 10 ** place;
  const decimals = Math.min(9, Math.max(0, -place + (leading < 1.95 ? 1 : 0)));
  return `${value.toFixed(decimals)} ± ${error.toFixed(decimals)}${end}`.replace("-", "−");
}

/** The last number of a list that is known. @param {(number | null)[]} values */
export function last(values) {
  for (let k = values.length - 1; k >= 0; k--) if (values[k] !== null) return k;
  return -1;
}

/** A duration in words. @param {number | null | undefined} seconds */
export function duration(seconds) {
  if (seconds === null || seconds === undefined) return "open";
  if (seconds < 95) return `${seconds < 12 ? Math.max(1, Math.round(seconds)) : 5 * Math.round(seconds / 5)} s`;
  return seconds < 5700 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toPrecision(2)} h`;
}
