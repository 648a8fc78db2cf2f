// Colours that colour-blind readers tell apart: Okabe and Ito (Color Universal Design, 2008) for kinds (the last is
// Tol's indigo), Brewer's YlGn for heights, viridis, cividis and plasma for other amounts (matplotlib's, in the ten steps of plotly.py's sequential.py), blue over
// grey to orange for signs, our choice.

export type Rgb = [number, number, number];

export interface Theme {
  dark: boolean;
  paper: string;
  ink: string;
  soft: string; // lesser text
  line: string; // grid lines
  kinds: string[];
  soil: string;
}

export const light: Theme = {
  dark: false, paper: "#ffffff", ink: "#1c2128", soft: "#57606a", line: "#d8dee4",
  kinds: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#4d4d4d", "#332288"], soil: "#a1762f",
};
export const dark: Theme = {
  dark: true, paper: "#161b22", ink: "#e6edf3", soft: "#9da7b3", line: "#30363d",
  kinds: ["#58a6dc", "#f0883e", "#2fc297", "#e29bc4", "#f2bd4a", "#9bd3f5", "#b0b8c1", "#a48bff"], soil: "#d6a461",
};

export const parsed = (colour: string): Rgb =>
  [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)) as Rgb;
export const hex = (rgb: Rgb): string =>
  "#" + rgb.map((part) => Math.round(part).toString(16).padStart(2, "0")).join("");

export type Ramp = (share: number) => Rgb;

function ramp(...stops: string[]): Ramp {
  const colours = stops.map(parsed);
  return (share) => {
    const at = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
    const i = Math.min(Math.floor(at), colours.length - 2);
    return colours[i].map((part, k) => part + (at - i) * (colours[i + 1][k] - part)) as Rgb;
  };
}

export const viridis = ramp(
  "#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725");
export const cividis = ramp(
  "#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369", "#e1cc55", "#fee838");
export const plasma = ramp(
  "#0d0887", "#46039f", "#7201a8", "#9c179e", "#bd3786", "#d8576b", "#ed7953", "#fb9f3a", "#fdca26", "#f0f921");
// Of heights, the taller the darker, as in plotview's pictures (viewer/view/internal/height_colours.cpp).
const ylGn = ramp("#ffffe5", "#f7fcb9", "#d9f0a3", "#addd8e", "#78c679", "#41ab5d", "#238443", "#006837", "#004529");
const kGround = 0.6 / 8; // where 0 m lies: bare ground is not the paper's white
export const heightRamp: Ramp = (share) => ylGn(kGround + Math.min(Math.max(share, 0), 1) * (1 - kGround));
export const signs = ramp("#1b5fa8", "#6fa8d6", "#e6e6e6", "#eda35c", "#b04d00");

// Of what a point lies on, by its label: unlabelled, ground, crop, weed, other.
export const classNames = ["unlabelled", "ground", "crop", "weed", "other"];
export const classColours: Rgb[] = ["#8c959f", "#b08d57", "#009e73", "#cc79a7", "#56b4e9"].map(parsed);

// Plots side by side have other colours.
const plotColours: Rgb[] = [
  "#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9", "#cc79a7", "#f0e442", "#7a5195", "#a0522d"].map(parsed);
export const plotColour = (number: number): Rgb => plotColours[number % plotColours.length];
export const noPlot: Rgb = [150, 150, 150];
