// The therapist's dashboard.
import { render } from "preact";
import { t } from "../strings";

const root = document.getElementById("app");
if (root) render(<p>{t("app.disclaimer")}</p>, root);
