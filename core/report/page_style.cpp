// The look of the page: calm type, one accent, tables that stay readable on paper.
#include "core/report/page.h"

namespace bl::report {

std::string_view page_style() {
  return R"(
:root{color-scheme:light dark;--ink:#21262f;--soft:#5b616c;--line:#dcd8ce;--page:#f4f2ec;--card:#fcfbf8;--good:#0f6b4a;--bad:#9c2f10;--accent:#225599}
@media (prefers-color-scheme:dark){:root{--ink:#e9e7e1;--soft:#a9adb6;--line:#3a3f49;--page:#16191f;--card:#1e222a;--good:#6fd0a6;--bad:#f2a27f;--accent:#8db8ea}
figure svg{filter:brightness(.9)}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);font:15px/1.5 system-ui,'Segoe UI','Helvetica Neue',Arial,'DejaVu Sans',sans-serif}
main,header,footer{max-width:1080px;margin:0 auto;padding:0 28px}
header{padding-top:40px}
h1{font-size:30px;line-height:1.2;font-weight:650;letter-spacing:-.01em;margin:0 0 6px}
h2{font-size:19px;font-weight:650;margin:44px 0 12px;padding-top:14px;border-top:2px solid var(--ink)}
p{margin:6px 0;max-width:75ch}
.about{color:var(--soft);font-size:16px}
.outcome{display:flex;gap:12px;align-items:baseline;flex-wrap:wrap;margin:18px 0 4px}
.badge{font-weight:650;border:1.5px solid currentColor;border-radius:4px;padding:2px 10px;white-space:nowrap}
.badge.good{color:var(--good)}.badge.bad{color:var(--bad)}
dl.keys{display:grid;grid-template-columns:repeat(4,1fr);gap:1px;background:var(--line);border:1px solid var(--line);margin:22px 0 28px}
dl.keys div{background:var(--card);padding:12px 14px}
dl.keys dt{color:var(--soft);font-size:12.5px}
dl.keys dd{margin:2px 0 0;font-size:21px;font-weight:600;font-variant-numeric:tabular-nums;letter-spacing:-.01em}
dl.keys dd small{display:block;font-size:12px;font-weight:400;letter-spacing:0;color:var(--soft)}
figure{margin:0 0 30px}
figure svg{display:block;width:100%;height:auto;border:1px solid var(--line)}
figcaption{color:var(--soft);font-size:13px;margin-top:8px;max-width:100ch}
.uses{display:flex;flex-wrap:wrap;gap:6px 20px;list-style:none;padding:0;margin:10px 0 0;font-size:13.5px}
.use{white-space:nowrap}
.swatch{display:inline-block;min-width:20px;padding:0 4px;margin-right:7px;text-align:center;font-size:11px;font-weight:700;line-height:18px;color:#21262f;border:1px solid #21262f55;border-radius:2px}
.wide{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:13.5px;font-variant-numeric:tabular-nums}
caption{text-align:left;color:var(--soft);font-size:13px;padding-bottom:8px}
th{font-weight:600;text-align:left;vertical-align:bottom;border-bottom:1.5px solid var(--ink);padding:6px 10px 6px 0;line-height:1.3}
th small{display:block;font-weight:400;color:var(--soft)}
td,tbody th,tfoot th{border-bottom:1px solid var(--line);padding:5px 10px 5px 0;vertical-align:top;font-weight:400}
tfoot td,tfoot th{border-top:1.5px solid var(--ink);font-weight:600}
.n{text-align:right;white-space:nowrap}
.good{color:var(--good)}.bad{color:var(--bad)}
.bar{display:inline-block;width:110px;height:9px;border:1px solid var(--soft);vertical-align:middle;margin-right:8px}
.bar span{display:block;height:100%;background:var(--accent)}
.reason{color:var(--soft);min-width:11em}
ul.plain{list-style:none;margin:0;padding:0}
footer{color:var(--soft);font-size:13px;padding-top:18px;padding-bottom:50px;margin-top:44px;overflow-wrap:anywhere}
footer dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px;margin:0}
footer dd{margin:0}
@media screen and (max-width:760px){dl.keys{grid-template-columns:repeat(2,1fr)}}
@media print{@page{size:A4;margin:14mm}
:root{color-scheme:light;--ink:#000;--soft:#444;--line:#ccc;--page:#fff;--card:#fff;--good:#0f6b4a;--bad:#9c2f10;--accent:#225599}
body{font-size:9.5pt}dl.keys dd{font-size:13pt}dl.keys{margin:10pt 0}dl.keys div{padding:6pt 8pt}main,header,footer{max-width:none;padding:0}header{padding-top:0}
h1{font-size:20pt}h2{font-size:13pt;margin-top:20pt}
figure,tr,dl.keys,.outcome{break-inside:avoid}h2,caption{break-after:avoid}figure svg{filter:none;max-height:230mm}
table{font-size:7.6pt}th,td,tbody th{padding:2.5pt 5pt 2.5pt 0}thead{display:table-header-group}tfoot{display:table-row-group}.wide{overflow:visible}
.bar,.bar span,.swatch,svg{print-color-adjust:exact;-webkit-print-color-adjust:exact}.bar{width:60pt}}
)";
}

}  // namespace bl::report
