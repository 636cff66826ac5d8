#include "report/page/html_style.hpp"

namespace enfilade {

const char* const report_style = R"css(
:root{--paper:#fbfaf8;--card:#fff;--ink:#1d2129;--soft:#667080;--line:#e2e0db;--accent:#b45f06;
--compute:#4e79a7;--io:#f28e2b;--idle:#c9c5bd;color-scheme:light dark}
@media (prefers-color-scheme:dark){:root{--paper:#14161a;--card:#1c1f25;--ink:#e6e4df;--soft:#98a1ae;--line:#31353d;
--accent:#f0a94e;--compute:#6d9bcb;--io:#f2a154;--idle:#555a63}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI",sans-serif}
main{max-width:1120px;margin:0 auto;padding:40px 24px 64px}
h1{font-size:30px;line-height:1.2;margin:0 0 4px;letter-spacing:-.01em}
h2{font-size:21px;margin:48px 0 14px;padding-top:22px;border-top:1px solid var(--line)}
h3{font-size:15px;margin:28px 0 10px;color:var(--soft);font-weight:600}
p{margin:6px 0}.soft{color:var(--soft)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(140px,1fr));gap:12px;margin:22px 0}
.tile{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:12px 14px}
.tile b{display:block;font-size:21px;font-variant-numeric:tabular-nums;line-height:1.3}
.tile span{color:var(--soft);font-size:13px}
figure{margin:0}figure img{display:block;width:100%;height:auto;border-radius:10px;border:1px solid var(--line)}
figcaption{color:var(--soft);font-size:13px;padding:6px 2px 0}
.hero{margin:22px 0}.grid2{display:grid;grid-template-columns:repeat(auto-fit,minmax(320px,1fr));gap:20px}
.card{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:16px}
.card>svg{display:block;width:100%;height:auto}
.grid{stroke:var(--line);stroke-width:1}.tick{fill:var(--soft);font:12px system-ui,sans-serif}
.plan{background:#fff;border-radius:6px}.stack{display:grid;gap:20px}
.legend{display:flex;flex-wrap:wrap;gap:4px 16px;font-size:13px;color:var(--soft);margin-bottom:8px}
.legend i{display:inline-block;width:11px;height:11px;border-radius:3px;margin-right:6px}
.scroll{overflow-x:auto}table{border-collapse:collapse;width:100%;font-size:14px}
th,td{text-align:left;padding:6px 12px 6px 0;border-bottom:1px solid var(--line);vertical-align:top}
td{font-variant-numeric:tabular-nums}th{font-weight:600}td.n,th.n{text-align:right}
.columns{columns:2 320px;column-gap:40px}.columns tr{break-inside:avoid}
.warn{border-left:3px solid var(--accent);padding:2px 0 2px 12px;margin:8px 0}
a{color:inherit;text-decoration-color:var(--line);text-underline-offset:3px}small{color:var(--soft);font-size:12px}
.sortable th{cursor:pointer;user-select:none;vertical-align:bottom}.sortable th[aria-sort]::after{content:" \25BE"}
.sortable th[aria-sort=ascending]::after{content:" \25B4"}.rooms td{white-space:nowrap}.good{color:#2e7d32}.bad{color:#c62828}
details.warnings{margin:28px 0}details.warnings summary{cursor:pointer;color:var(--soft)}
@media print{body{background:#fff}.tile,.card{break-inside:avoid}}
)css";

}  // namespace enfilade
