// The therapist's dashboard.
import { render } from "preact";
// The look comes first, so that a page's own style may differ from it.
import "uplot/dist/uPlot.min.css";
import "./style.css";
import "./controls.css";
import "./parts.css";
import { App } from "./app";

const root = document.getElementById("app");
if (root) render(<App />, root);
