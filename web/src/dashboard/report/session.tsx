// The report of one session.
export function SessionReport({ id }: { id: number }) {
  return <main class="page" data-testid="report" data-session={id} />;
}
