/* The summary of a model: figures and text of a known mechanism, and what is refused. */
#include "check.h"
#include <math.h>
#include <stdint.h>

static const double BALL[9] = {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1};
static const double Z[3] = {0, 0, 1}, ORIGIN[3] = {0, 0, 0};

static int32_t ball(pdn_model *model, double x)
{
    const double centre[3] = {x, 0, 0};
    int32_t node;
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2.0, centre, BALL, &node), PDN_OK);
    return node;
}

static pdn_summary summary_of(const pdn_model *model)
{
    pdn_summary summary;
    PDN_INIT(pdn_summary, &summary);
    CHECK_STATUS(pdn_model_summary(model, &summary), PDN_OK);
    return summary;
}

static int describes(const pdn_model *model, const char *text)
{
    char description[2048];
    const size_t length = pdn_model_describe(model, description, sizeof description);
    CHECK(length > 0 && length < sizeof description && strlen(description) == length);
    CHECK(pdn_model_describe(model, NULL, 0) == length);
    return strstr(description, text) != NULL;
}

/* Two hinges on one axis hold a body five times too often; another body is free. */
static void figures_of_a_small_model(void)
{
    pdn_model *model = NULL;
    pdn_summary summary;
    pdn_signal swing;
    const double cosines[1] = {0.2}, sines[1] = {0};
    int32_t door, hinge;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    door = ball(model, 1.0);
    ball(model, 4.0);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, door, ORIGIN, Z, &hinge), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, door, Z, Z, &hinge), PDN_OK);
    summary = summary_of(model);
    CHECK(summary.nodes == 2 && summary.beam_elements == 0 && summary.joints == 2);
    CHECK(summary.prescribed == 0 && summary.constraints == 10);
    CHECK(summary.redundant_constraints == 5 && summary.redundant_if_rigid == 5);
    CHECK(summary.degrees_of_freedom == 7 && summary.mobility == 7 && summary.members == 2);
    CHECK(summary.parts == 2 && summary.warnings == 1);
    CHECK(summary.mass == 4.0 && fabs(summary.centre[0] - 2.5) < 1e-15);
    CHECK(describes(model, "5 redundant constraints among joints 0, 1"));
    CHECK(describes(model, "warning: nothing connects node 1 to the rest"));

    /* A driven hinge takes one more freedom. */
    PDN_INIT(pdn_signal, &swing);
    CHECK_STATUS(pdn_signal_set_harmonics(&swing, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, hinge, PDN_ROTATION, &swing, NULL), PDN_OK);
    summary = summary_of(model);
    CHECK(summary.prescribed == 1 && summary.constraints == 11 && summary.mobility == 6);
    pdn_model_free(model);
}

static void what_is_refused(void)
{
    pdn_model *model = NULL;
    pdn_summary summary, before;
    char text[8] = "keep me";
    const size_t sizes[] = {0, 7, 5000, SIZE_MAX};
    size_t k;
    PDN_INIT(pdn_summary, &summary);
    memset((char *)&summary + sizeof summary.struct_size, 0x5a,
           sizeof summary - sizeof summary.struct_size);
    before = summary;
    pdn_summary_init(NULL, sizeof summary);
    CHECK_MESSAGE("summary: expected a pointer, got NULL");
    for (k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        pdn_summary_init(&summary, sizes[k]);
        CHECK_MESSAGE("struct_size: expected between");
        CHECK(memcmp(&summary, &before, sizeof summary) == 0);
    }
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_summary(model, &summary), PDN_ERR_MODEL);
    CHECK_MESSAGE("at least one node");
    CHECK(pdn_model_describe(model, text, sizeof text) == 0);
    CHECK_MESSAGE("at least one node");
    CHECK(strcmp(text, "keep me") == 0);
    ball(model, 1.0);
    CHECK_STATUS(pdn_model_summary(NULL, &summary), PDN_ERR_NULL);
    CHECK_MESSAGE("model");
    CHECK_STATUS(pdn_model_summary(model, NULL), PDN_ERR_NULL);
    CHECK_MESSAGE("out");
    CHECK(pdn_model_describe(NULL, text, sizeof text) == 0);
    CHECK_MESSAGE("model");
    CHECK(memcmp(&summary, &before, sizeof summary) == 0);
    summary.struct_size = 8;
    before = summary;
    CHECK_STATUS(pdn_model_summary(model, &summary), PDN_ERR_STRUCT_SIZE);
    summary.struct_size = SIZE_MAX;
    CHECK_STATUS(pdn_model_summary(model, &summary), PDN_ERR_STRUCT_SIZE);
    before.struct_size = summary.struct_size;
    CHECK(memcmp(&summary, &before, sizeof summary) == 0);
    pdn_model_free(model);
}

int main(void)
{
    figures_of_a_small_model();
    what_is_refused();
    puts("model summary: figures, text and refusals as they should be");
    return 0;
}
