// What went wrong, what would have been right, and what to do.
import type { Problem } from "../api/client";
import { t } from "../strings";
import { said } from "../strings/said";
import { sentence } from "./format";

interface Props {
  problem: Problem | null;
  onClose?: () => void;
  onRetry?: () => void;
}

export function ProblemBox({ problem, onClose, onRetry }: Props) {
  if (!problem) return null;
  const { what, expected, remedy } = problem.detail;
  return (
    <div class="problem" role="alert" data-testid="problem">
      <span class="problem-sign" aria-hidden="true">
        ⚠
      </span>
      <div class="problem-words">
        <strong>{sentence(what)}</strong>
        {expected && <span>{t("problem.expected", { expected: said(expected) })}</span>}
        {remedy && <span>{t("problem.remedy", { remedy: said(remedy) })}</span>}
      </div>
      {onRetry && (
        <button type="button" onClick={onRetry}>
          {t("problem.retry")}
        </button>
      )}
      {onClose && (
        <button type="button" class="quiet" aria-label={t("action.close")} onClick={onClose}>
          ✕
        </button>
      )}
    </div>
  );
}
